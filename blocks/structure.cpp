// The declarations that read the block's text: structure, which fixes the shape of a block.
#include <fmt/format.h>

#include <algorithm>

#include "blocks/block.h"

namespace flyball {

bool Block::given(const std::string& key) const { return settings_ != nullptr && settings_->given(key); }

void Block::refuse(const std::string& key, std::string message) {
  spec_.refused = true;
  if (settings_ != nullptr) settings_->refuse(key, std::move(message));
}

std::string Block::text(const std::string& key, const std::string& fallback, std::string doc) {
  spec_.structure.push_back({key, fmt::format("\"{}\"", fallback), std::move(doc), {}});
  return settings_ == nullptr ? fallback : settings_->text(key).value_or(fallback);
}

std::string Block::choice(const std::string& key, const std::string& fallback,
                          std::vector<std::string> choices, std::string doc) {
  const std::string chosen = text(key, fallback, std::move(doc));
  spec_.structure.back().choices = choices;
  if (std::ranges::find(choices, chosen) != choices.end()) return chosen;
  refuse(key, fmt::format("expected \"{}\", found \"{}\"", fmt::join(choices, "\", \""), chosen));
  return fallback;
}

int Block::option(const std::string& key, const std::string& fallback, std::vector<std::string> choices,
                  std::string doc) {
  const std::string chosen = choice(key, fallback, choices, std::move(doc));
  return static_cast<int>(std::ranges::find(choices, chosen) - choices.begin());
}

int Block::count(const std::string& key, int fallback, int least, int most, std::string doc) {
  spec_.structure.push_back({key, std::to_string(fallback), std::move(doc), {}});
  if (settings_ == nullptr) return fallback;
  const long n = settings_->integer(key).value_or(fallback);
  if (n >= least && n <= most) return static_cast<int>(n);
  refuse(key, fmt::format("expected a whole number from {} to {}, found {}", least, most, n));
  return fallback;
}

bool Block::flag(const std::string& key, bool fallback, std::string doc) {
  spec_.structure.push_back({key, fallback ? "true" : "false", std::move(doc), {}});
  return settings_ == nullptr ? fallback : settings_->flag(key).value_or(fallback);
}

std::vector<std::string> Block::list(const std::string& key, const std::vector<std::string>& fallback,
                                     std::string doc) {
  spec_.structure.push_back(
      {key, fmt::format("[\"{}\"]", fmt::join(fallback, "\", \"")), std::move(doc), {}});
  return settings_ == nullptr ? fallback : settings_->list(key).value_or(fallback);
}

std::vector<int> Block::counts(const std::string& key, const std::vector<int>& fallback, int least, int most,
                               std::string doc) {
  spec_.structure.push_back({key, fmt::format("[{}]", fmt::join(fallback, ", ")), std::move(doc), {}});
  if (settings_ == nullptr) return fallback;
  const auto read = settings_->integers(key);
  if (!read) return fallback;
  const auto wrong = std::ranges::find_if(*read, [&](long n) { return n < least || n > most; });
  if (wrong == read->end() && !read->empty()) return {read->begin(), read->end()};
  const std::string found = read->empty() ? "an empty list" : std::to_string(*wrong);
  refuse(key, fmt::format("expected whole numbers from {} to {}, found {}", least, most, found));
  return fallback;
}

SampleTime Block::sample_time(Rational fallback) {
  spec_.structure.push_back(
      {"sample_time", fmt::format("\"{} s\"", fallback.value()), "time between two hits, exact", {}});
  spec_.structure.push_back({"offset", "\"0 s\"", "time of the first hit, exact", {}});
  if (settings_ != nullptr && !given("sample_time"))
    refuse("", "a sampled block needs a sample_time, such as sample_time = \"10 ms\"");
  return sampled(fallback);
}

SampleTime Block::sample_time_if_given() {
  spec_.structure.push_back({"sample_time",
                             "\"\"",
                             "time between two hits, exact; without it, the block answers at all times",
                             {}});
  spec_.structure.push_back({"offset", "\"0 s\"", "time of the first hit, exact", {}});
  if (given("sample_time")) return sampled(Rational(1));
  if (given("offset")) refuse("offset", "a block without a sample_time has no hits");
  return {};
}

SampleTime Block::sampled(Rational fallback) {
  Rational period = fallback;
  if (settings_ != nullptr) {
    period = settings_->exact("sample_time").value_or(fallback);
    spec_.offset = settings_->exact("offset").value_or(Rational(0));
  }
  if (period.numerator() <= 0) {
    refuse("sample_time", fmt::format("expected a time above 0 s, found {} s", period.value()));
    period = Rational(1);
  }
  if (spec_.offset.numerator() < 0) {
    refuse("offset", fmt::format("expected a time of at least 0 s, found {} s", spec_.offset.value()));
    spec_.offset = Rational(0);
  }
  spec_.period = period;
  const Param ts = param("sample_time", period.value(), "s", positive, "time between two hits");
  spec_.slots[ts.slot].fixed = true;
  return {ts.slot};
}

namespace {

Shape shape_of(const std::vector<std::vector<double>>& table) {
  Shape shape{static_cast<int>(table.size()), table.empty() ? 0 : static_cast<int>(table[0].size()), {}};
  for (const auto& row : table) {
    for (const double entry : row) shape.zero.push_back(entry == 0.0);
  }
  return shape;
}

std::vector<double> flat(const std::vector<std::vector<double>>& table) {
  std::vector<double> result;
  for (const auto& row : table) result.insert(result.end(), row.begin(), row.end());
  return result;
}

std::string written(const std::vector<double>& row) { return fmt::format("[{}]", fmt::join(row, ", ")); }

}  // namespace

Coefficients Block::declare_coefficients(const std::string& key, const Shape& shape,
                                         const std::vector<double>& fallback, bool one_row, std::string unit,
                                         std::string doc) {
  std::vector<Coefficients::Entry> entries;
  for (int r = 0; r < shape.rows; ++r) {
    for (int c = 0; c < shape.columns; ++c) {
      const int at = r * shape.columns + c;
      if (shape.zero[at]) continue;
      std::string name = one_row ? fmt::format("{}[{}]", key, c) : fmt::format("{}[{}][{}]", key, r, c);
      const double value = at < static_cast<int>(fallback.size()) ? fallback[at] : 0.0;
      const Param p = param(std::move(name), value, unit, any, doc);
      spec_.slots[p.slot].setting = key;
      spec_.slots[p.slot].entry = at;
      entries.push_back({r, c, p});
    }
  }
  return {shape.rows, shape.columns, std::move(entries)};
}

Coefficients Block::coefficients(const std::string& key, const std::vector<double>& fallback,
                                 std::string unit, std::string doc, Entries entries) {
  spec_.structure.push_back({key, written(fallback), doc, {}});
  Shape shape = shape_of({fallback});
  if (given(key)) {
    const auto read = settings_->shape(key);
    if (read && read->rows == 1) {
      shape = *read;
    } else if (read) {
      refuse(key, "expected a list of numbers, found a list of lists");
    }
  }
  if (entries != Entries::not_zero) std::fill(shape.zero.begin(), shape.zero.end(), false);
  Coefficients result = declare_coefficients(key, shape, fallback, true, std::move(unit), std::move(doc));
  for (int k = 1; entries == Entries::increasing && k < result.columns(); ++k) {
    spec_.slots[result.entries()[k].param.slot].exceeds = result.entries()[k - 1].param.slot;
  }
  return result;
}

Coefficients Block::matrix(const std::string& key, const std::vector<std::vector<double>>& fallback,
                           std::string doc, Entries entries) {
  std::vector<std::string> rows;
  for (const auto& row : fallback) rows.push_back(written(row));
  spec_.structure.push_back({key, fmt::format("[{}]", fmt::join(rows, ", ")), doc, {}});
  Shape shape = shape_of(fallback);
  if (given(key)) shape = settings_->shape(key).value_or(shape);
  if (entries != Entries::not_zero) std::fill(shape.zero.begin(), shape.zero.end(), false);
  return declare_coefficients(key, shape, flat(fallback), false, "any", std::move(doc));
}

NumberRows Block::lengths(const std::string& key, const NumberRows& fallback, std::string doc) {
  std::vector<std::string> rows;
  for (const auto& row : fallback) rows.push_back(written(row));
  spec_.structure.push_back({key, fmt::format("[{}]", fmt::join(rows, ", ")), std::move(doc), {}});
  return settings_ == nullptr ? fallback : settings_->lengths(key).value_or(fallback);
}

std::optional<NumberRows> Block::columns(const std::string& file, const std::vector<std::string>& names,
                                         const std::string& unit) {
  spec_.structure.push_back({file,
                             "\"\"",
                             fmt::format("comma-separated values with the columns {}, in {} without another "
                                         "unit; the path begins at the model file",
                                         fmt::join(names, ", "), unit),
                             {}});
  return given(file) ? settings_->columns(file, names, unit) : std::nullopt;
}

std::shared_ptr<const TimeSeries> Block::time_series(const std::string& file, const std::string& column) {
  spec_.structure.push_back({file, "\"\"", "comma-separated values; the path begins at the model file", {}});
  spec_.structure.push_back(
      {column, "\"\"", "name of the column; with one column beside time it may be left out", {}});
  std::shared_ptr<const TimeSeries> read;
  if (settings_ != nullptr && !given(file))
    refuse("", "expected a file, such as " + file + " = \"step.csv\"");
  if (given(file)) read = settings_->time_series(file, column);
  return read != nullptr ? read : std::make_shared<const TimeSeries>(TimeSeries{"any", {0.0}, {0.0}});
}

namespace {

/// The formula that is its first input.
std::shared_ptr<const Formula> identity(const std::string& input) {
  auto formula = std::make_shared<Formula>();
  formula->text = input;
  formula->operands = {input};
  Formula::Node node;
  node.op = Formula::Op::operand;
  formula->nodes.push_back(node);
  return formula;
}

}  // namespace

std::shared_ptr<const Formula> Block::formula(const std::string& key, const std::string& fallback_input,
                                              const std::vector<std::string>& inputs, std::string doc) {
  spec_.structure.push_back({key, fmt::format("\"{}\"", fallback_input), std::move(doc), {}});
  std::shared_ptr<const Formula> read;
  if (given(key)) read = settings_->formula(key, inputs);
  if (read == nullptr) return identity(fallback_input);
  auto numbered = std::make_shared<Formula>(*read);
  numbered->number_literals(static_cast<int>(spec_.literals.size()));
  std::ranges::copy_if(numbered->nodes, std::back_inserter(spec_.literals),
                       [](const Formula::Node& node) { return node.op == Formula::Op::literal; });
  return numbered;
}

}  // namespace flyball
