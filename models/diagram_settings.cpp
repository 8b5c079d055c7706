#include "models/diagram_settings.h"

#include <fmt/format.h>

#include <filesystem>

#include "models/language/messages.h"

namespace flyball {
namespace {

using Kind = TomlValue::Kind;

bool is_entry(const TomlValue& value) { return value.numeric() || value.is(Kind::string); }

/// A text that differs whenever the value does.
void append(std::string& result, const TomlValue& value) {
  switch (value.kind) {
    case Kind::boolean:
      result += value.flag ? 't' : 'f';
      break;
    case Kind::integer:
      fmt::format_to(std::back_inserter(result), "i{}", value.integer);
      break;
    case Kind::number:
      fmt::format_to(std::back_inserter(result), "n{}", value.number);
      break;
    case Kind::string:
      fmt::format_to(std::back_inserter(result), "s{}:{}", value.text.size(), value.text);
      break;
    default:
      result += '[';
      for (const TomlValue& item : value.items) append(result, item);
      result += ']';
  }
}

}  // namespace

const TomlValue* TableSettings::find(std::string_view key, Use use) const {
  auto asked = uses_.find(key);
  if (asked == uses_.end()) asked = uses_.emplace(key, 0).first;
  asked->second |= use;
  return block_.value.find(key);
}

bool TableSettings::given(std::string_view key) const { return find(key, Use{}) != nullptr; }

std::optional<std::string> TableSettings::text(std::string_view key) {
  const TomlValue* value = find(key, as_written);
  if (value == nullptr || !report_.expect(*value, Kind::string, "a text in quotes")) return std::nullopt;
  return value->text;
}

std::optional<long> TableSettings::integer(std::string_view key) {
  const TomlValue* value = find(key, as_whole);
  if (value == nullptr) return std::nullopt;
  if (value->is(Kind::string)) {
    const auto whole = expressions_.exact(*value, "1");
    if (whole && whole->denominator() == 1) return whole->numerator();
    if (whole) report_.error(*value, message::not_whole(whole->value()));
    return std::nullopt;
  }
  if (!report_.expect(*value, Kind::integer, "a whole number")) return std::nullopt;
  return value->integer;
}

std::optional<std::vector<long>> TableSettings::integers(std::string_view key) {
  const TomlValue* value = find(key, as_written);
  if (value == nullptr || !report_.expect(*value, Kind::list, "a list of whole numbers")) return std::nullopt;
  std::vector<long> result;
  for (const TomlValue& item : value->items) {
    if (!report_.expect(item, Kind::integer, "a whole number")) return std::nullopt;
    result.push_back(item.integer);
  }
  return result;
}

std::optional<bool> TableSettings::flag(std::string_view key) {
  const TomlValue* value = find(key, as_written);
  if (value == nullptr || !report_.expect(*value, Kind::boolean, "true or false")) return std::nullopt;
  return value->flag;
}

std::optional<Rational> TableSettings::exact(std::string_view key) {
  const TomlValue* value = find(key, as_time);
  // Structure that is read exactly is time: sample times and offsets.
  return value == nullptr ? std::nullopt : expressions_.exact(*value, "s");
}

std::optional<std::vector<std::string>> TableSettings::list(std::string_view key) {
  const TomlValue* value = find(key, as_written);
  if (value == nullptr || !report_.expect(*value, Kind::list, "a list of texts")) return std::nullopt;
  std::vector<std::string> result;
  for (const TomlValue& item : value->items) {
    if (!report_.expect(item, Kind::string, "a text in quotes")) return std::nullopt;
    result.push_back(item.text);
  }
  return result;
}

std::optional<Shape> TableSettings::shape(std::string_view key) {
  const TomlValue* value = find(key, as_shape);
  if (value == nullptr || !report_.expect(*value, Kind::list, "a list of numbers")) return std::nullopt;
  if (value->items.empty()) {
    report_.error(*value, message::empty_list());
    return std::nullopt;
  }
  const bool table = value->items[0].is(Kind::list);
  Shape result{table ? static_cast<int>(value->items.size()) : 1, 0, {}};
  const auto row = [&](const TomlValue& numbers) {
    for (const TomlValue& item : numbers.items) {
      if (!is_entry(item))
        return report_.error(item, message::wrong_type("a number or an expression", item)), false;
      result.zero.push_back(item.numeric() && item.number == 0.0);
    }
    return true;
  };
  result.columns = static_cast<int>((table ? value->items[0] : *value).items.size());
  if (!table) return row(*value) ? std::optional(result) : std::nullopt;
  for (const TomlValue& item : value->items) {
    if (!report_.expect(item, Kind::list, "a list of numbers") || !row(item)) return std::nullopt;
    if (static_cast<int>(item.items.size()) == result.columns) continue;
    report_.error(item, message::ragged_table(result.columns, item.items.size()));
    return std::nullopt;
  }
  return result;
}

std::shared_ptr<const Formula> TableSettings::formula(std::string_view key,
                                                      const std::vector<std::string>& inputs) {
  const TomlValue* value = find(key, as_formula);
  if (value == nullptr || !report_.expect(*value, Kind::string, "an expression in quotes")) return nullptr;
  auto parsed = expressions_.formula(*value, inputs);
  return parsed ? std::make_shared<const Formula>(*std::move(parsed)) : nullptr;
}

std::optional<std::vector<double>> TableSettings::length_row(const TomlValue& row) const {
  const bool one = is_entry(row);
  if (!one && !report_.expect(row, Kind::list, "lengths")) return std::nullopt;
  std::vector<double> result;
  for (const TomlValue& item : one ? std::vector<TomlValue>{row} : row.items) {
    if (!is_entry(item)) {
      report_.error(item, message::wrong_type("a length", item));
      return std::nullopt;
    }
    const auto length = expressions_.fixed(item, "m");
    if (!length) return std::nullopt;
    result.push_back(*length);
  }
  return result;
}

std::optional<NumberRows> TableSettings::lengths(std::string_view key) {
  const TomlValue* value = find(key, as_lengths);
  if (value == nullptr) return std::nullopt;
  const bool table = value->is(Kind::list) && (value->items.empty() || value->items[0].is(Kind::list));
  NumberRows rows;
  for (const TomlValue& row : table ? value->items : std::vector<TomlValue>{*value}) {
    auto read = length_row(row);
    if (!read) return std::nullopt;
    rows.push_back(*std::move(read));
  }
  return rows;
}

std::string TableSettings::path_of(const TomlValue& file) const {
  return (std::filesystem::path(report_.file()).parent_path() / file.text).string();
}

std::optional<NumberRows> TableSettings::columns(std::string_view file, const std::vector<std::string>& names,
                                                 const std::string& unit) {
  const TomlValue* value = find(file, as_file);
  if (value == nullptr || !report_.expect(*value, Kind::string, "the name of a file in quotes"))
    return std::nullopt;
  const DataFiles::Content& content = files_.open(path_of(*value));
  std::vector<Diagnostic> problems = content.problems;
  std::optional<NumberRows> rows;
  if (content.table) {
    Diagnostics diagnostics(path_of(*value));
    rows = read_columns(*content.table, names, unit, diagnostics);
    problems = diagnostics.sorted();
  }
  for (const Diagnostic& problem : problems) report_.error(*value, message::in_data_file(to_string(problem)));
  return rows;
}

std::shared_ptr<const TimeSeries> TableSettings::time_series(std::string_view file, std::string_view column) {
  const TomlValue* value = find(file, as_file);
  if (value == nullptr || !report_.expect(*value, Kind::string, "the name of a file in quotes"))
    return nullptr;
  const auto name = text(column);
  const TomlValue* given_column = block_.value.find(column);
  if (given_column != nullptr && !name) return nullptr;
  const DataFiles::Content& content = files_.open(path_of(*value));
  std::vector<Diagnostic> problems = content.problems;
  std::shared_ptr<const TimeSeries> series;
  if (content.table) {
    Diagnostics diagnostics(path_of(*value));
    series = read_time_series(*content.table, name.value_or(""), diagnostics);
    problems = diagnostics.sorted();
  }
  const bool column_is_wrong = content.table && name && content.table->find(*name) < 0;
  for (const Diagnostic& problem : problems) {
    report_.error(column_is_wrong ? *given_column : *value, message::in_data_file(to_string(problem)));
  }
  return series;
}

void TableSettings::refuse(std::string_view key, std::string message) {
  // A value that could not be read was replaced by its default: what the block refuses may only follow from
  // that.
  if (report_.errors() > errors_before_ + refusals_) return;
  ++refusals_;
  if (const TomlValue* value = block_.value.find(key)) {
    report_.error(*value, message::setting_refused(key, message));
  } else {
    report_.error(block_.at, message::block_refused(block_.key, message));
  }
}

void TableSettings::append_exact(std::string& result, const TomlValue& value, const std::string& unit) {
  const auto number = expressions_.exact(value, unit);
  if (!number) return;
  fmt::format_to(std::back_inserter(result), "{}/{}", number->numerator(), number->denominator());
}

void TableSettings::append_shape(std::string& result, std::string_view key) {
  const auto form = shape(key);
  if (!form) return;
  fmt::format_to(std::back_inserter(result), "{}x{}:", form->rows, form->columns);
  for (const bool zero : form->zero) result += zero ? '0' : '1';
}

void TableSettings::append_lengths(std::string& result, std::string_view key) {
  const auto rows = lengths(key);
  if (!rows) return;
  for (const auto& row : *rows) fmt::format_to(std::back_inserter(result), "[{}]", fmt::join(row, ","));
}

/// What a formula means also depends on the names that it sees: those of one definition.
void TableSettings::append_formula(std::string& result, const TomlValue& value) {
  append(result, value);
  fmt::format_to(std::back_inserter(result), "@{}", expressions_.subsystem().type.number);
}

std::string TableSettings::structure(const Uses& uses) {
  std::string result;
  for (const auto& [key, use] : uses) {
    const TomlValue* value = block_.value.find(key);
    if (value == nullptr) continue;
    result += key;
    result += '=';
    if ((use & as_written) != 0) append(result, *value);
    if ((use & as_time) != 0) append_exact(result, *value, "s");
    // 3.0 is not taken where a whole number is wanted.
    if ((use & as_whole) != 0 && value->is(Kind::number)) result += '.';
    if ((use & as_whole) != 0) append_exact(result, *value, "1");
    if ((use & as_file) != 0 && value->is(Kind::string)) result += path_of(*value);
    if ((use & as_shape) != 0) append_shape(result, key);
    if ((use & as_lengths) != 0) append_lengths(result, key);
    if ((use & as_formula) != 0) append_formula(result, *value);
    result += ';';
  }
  return result;
}

}  // namespace flyball
