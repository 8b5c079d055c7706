#pragma once
#include <algorithm>

#include "blocks/block.h"

namespace flyball {

/// What the continuous and the sampled linear system have in common: A, B, C, D and the start.
struct StateSpaceTerms : Block {
  Coefficients A = matrix("A", {{-1.0}}, "state matrix");
  Coefficients B = matrix("B", {{1.0}}, "input matrix");
  Coefficients C = matrix("C", {{1.0}}, "output matrix");
  Coefficients D = matrix("D", {{0.0}}, "feedthrough matrix, 0 if not given");
  Coefficients initial = coefficients("initial", {}, "any", "state at the start, 0 if not given");
  Inputs u = B.columns() == 1 ? Inputs(input("u", "any", "input").slot, 1)
                              : input_vector("u", B.columns(), "any", "input");
  Outputs y = C.rows() == 1 ? Outputs(output("y", "any", "output").slot, 1)
                            : output_vector("y", C.rows(), "any", "output");

  explicit StateSpaceTerms(Settings* settings) : Block(settings) {
    const int n = A.rows(), inputs = B.columns(), outputs = C.rows();
    if (n == 0) refuse("A", "expected at least one row");
    expect("A", A, n, n);
    expect("B", B, n, std::max(inputs, 1));
    expect("C", C, std::max(outputs, 1), n);
    if (given("D")) expect("D", D, outputs, inputs);
    if (given("initial")) expect("initial", initial, 1, n);
  }

 protected:
  /// Of each state, the parameter that gives its value at the start.
  std::vector<Param> start() const {
    std::vector<Param> all = initial.params(0);
    all.resize(A.rows());
    return all;
  }
  /// Row i of matrix times vector.
  static auto product(auto& v, const Coefficients& matrix, int i, const auto& vector) {
    auto sum = v.number(0.0);
    for (const auto& m : matrix.row(i)) sum += v[m.param] * v[vector[m.column]];
    return sum;
  }

 private:
  void expect(const std::string& key, const Coefficients& found, int rows, int columns) {
    if (found.rows() == rows && found.columns() == columns) return;
    const auto size = [](int r, int c) { return std::to_string(r) + " by " + std::to_string(c); };
    refuse(key, "expected " + size(rows, columns) + " numbers, found " + size(found.rows(), found.columns()));
  }
};

}  // namespace flyball
