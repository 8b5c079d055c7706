#pragma once

#include <functional>
#include <string>
#include <vector>

#include "studies/engine/store.h"
#include "studies/language/run_table.h"

namespace flyball {

/// All that the results of a study are written from.
struct StudyData {
  const Study& study;
  const RunTable& table;
  const Store& store;
};

/// The runs that differ in their sample alone, and what they gave.
struct Cell {
  RunPlace place;                  // of its first run
  std::int64_t first = 0;          // number of that run
  std::vector<RunRecord> records;  // sample by sample
};

/// Cells in order of their runs; only one of them is in memory.
void for_each_cell(const StudyData& data, const std::function<void(const Cell&)>& each);
Cell read_cell(const StudyData& data, std::int64_t first);

/// The numbers of a metric in a cell, NaN where a run has none.
std::vector<double> values_of(const Cell& cell, std::size_t metric);

/// What tells cells apart: headings and, for a place, the cells below them. With `all`, also what is the same
/// everywhere in the study.
class PlaceColumns {
 public:
  PlaceColumns(const Study& study, bool all);

  std::vector<std::string> header() const;
  std::vector<std::string> cells(const RunPlace& place) const;

 private:
  const Study& study_;
  bool model_, choice_, scenario_;
};

/// A line of comma-separated values (RFC 4180, ends in LF).
std::string csv_line(const std::vector<std::string>& fields);

/// The shortest form that reads back to the same double; "nan" where there is no number.
std::string csv_number(double x);

/// Six digits for people; "-" where there is no number.
std::string shown_number(double x);

}  // namespace flyball
