#pragma once

#include <vector>

namespace flyball {

/// Compressed sparse columns: the rows of column c are row[start[c]] … row[start[c + 1] - 1], ascending.
struct Sparsity {
  int size = 0;
  std::vector<int> start;
  std::vector<int> row;
};

/// Groups of columns that share no row, so that one derivative direction serves a whole group.
struct Colouring {
  int colours = 0;
  std::vector<int> colour;  // of each column
};

/// Greedy, in column order (Curtis, Powell, Reid 1974): 3 colours for a tridiagonal matrix of any size.
Colouring colour_columns(const Sparsity& pattern);

}  // namespace flyball
