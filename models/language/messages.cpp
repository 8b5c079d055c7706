#include "models/language/messages.h"

#include <fmt/format.h>

#include <cmath>

#include "models/language/nearest.h"
#include "models/language/units.h"

namespace flyball::message {
namespace {

using fmt::format;

/// What the writer may have meant: the nearest name, or all names when they are few.
std::string suggestion(Text name, const Names& known) {
  constexpr std::size_t few = 8;
  if (const auto meant = nearest(name, known)) return format("; did you mean \"{}\"?", *meant);
  if (known.empty() || known.size() > few) return {};
  return format("; known: {}", fmt::join(known, ", "));
}

Text direction(bool is_input) { return is_input ? "input" : "output"; }

std::string in_unit(double value, Text unit) {
  return unit == "any" || unit == "1" ? format("{}", value) : format("{} {}", value, unit);
}

std::string in_words(const Range& range, Text unit) {
  const bool low = range.lower > -infinity;
  const bool high = range.upper < infinity;
  if (low && high) {
    const std::string from = range.lower_open ? "above " : "from ";
    const std::string to = range.upper_open ? " and below " : " to ";
    return from + in_unit(range.lower, unit) + to + in_unit(range.upper, unit);
  }
  if (low) return (range.lower_open ? "above " : "at least ") + in_unit(range.lower, unit);
  return (range.upper_open ? "below " : "at most ") + in_unit(range.upper, unit);
}

std::string in_words(const Dimension& dimension) {
  return dimension == Dimension{} ? "a plain number" : to_string(dimension);
}

Text kind_of(const TomlValue& value) {
  switch (value.kind) {
    case TomlValue::Kind::boolean:
      return value.flag ? "true" : "false";
    case TomlValue::Kind::integer:
      return "a whole number";
    case TomlValue::Kind::number:
      return "a decimal number";
    case TomlValue::Kind::string:
      return "a text";
    case TomlValue::Kind::date:
      return "a date";
    case TomlValue::Kind::list:
      return "a list";
    case TomlValue::Kind::table:
      return "a table";
  }
  return "";
}

}  // namespace

std::string unreadable(Text reason) { return format("cannot be read: {}", reason); }
std::string not_utf8(unsigned char byte) {
  return format("not UTF-8: unexpected byte 0x{:02X}; save the file as UTF-8", byte);
}
std::string line_too_long(std::size_t limit) {
  return format("the line is longer than {} bytes; a list may stand on several lines", limit);
}
std::string nested_too_deeply(int limit) { return format("nested more than {} levels deep", limit); }
std::string syntax(Text reason) {
  if (reason.starts_with("unescaped control")) reason = "a text in quotes ends on the line where it began";
  return format("not TOML: {}", reason);
}
std::string stands_twice(Text key) {
  return format("\"{}\" stands twice; give one of them another name", key);
}
std::string first_stands_here(Text key) { return format("\"{}\" stands here first", key); }
std::string section_stands_twice(Text reason) {
  return format("{}; a table or section is written once", reason);
}
std::string not_a_finite_literal(Text literal) {
  return format("expected a finite number, found {}", literal);
}
std::string wrong_type(Text expected, const TomlValue& found) {
  return format("expected {}, found {}", expected, kind_of(found));
}
std::string unknown_key(Text key, Text owner, const Names& known) {
  return format("{} has no key \"{}\"{}", owner, key, suggestion(key, known));
}
std::string missing_key(Text key, Text owner) { return format("{} has no \"{}\"", owner, key); }
std::string missing_section(Text name) { return format("section [{}] is missing", name); }
std::string missing_version(int version) {
  return format("the version of the file format is missing: write \"flyball = {}\" at the top", version);
}
std::string unknown_version(std::int64_t found, int known) {
  return format("expected version {} of the file format, found {}", known, found);
}
std::string not_a_name(Text name) {
  return format(
      "\"{}\" is no name: use letters, digits and _, start with a letter, and avoid and, or, not, if", name);
}
std::string in_override(Text name, Text message) { return format("--set {}: {}", name, message); }
std::string no_such_entry(Text block, Text setting) {
  return format("block \"{}\" has no entry {} in the file", block, setting);
}

std::string used_here(Text name) { return format("used here, as \"{}\"", name); }
std::string unreadable_file(Text file, Text reason) { return format("{} cannot be read: {}", file, reason); }
std::string file_without_ports() {
  return "this file has no section [ports], so it cannot be used as a block";
}
std::string cyclic_subsystems(Text chain) { return format("subsystems contain each other: {}", chain); }
std::string hierarchy_too_deep(int limit) {
  return format("subsystems are nested more than {} levels deep", limit);
}
std::string too_many_blocks(long limit) { return format("this takes the model beyond {} blocks", limit); }
std::string name_of_block_type(Text name) {
  return format("\"{}\" is a block type already; give the subsystem another name", name);
}
std::string block_and_port(Text name) {
  return format("\"{}\" is the name of a port, too; give one of them another name", name);
}
std::string unused_subsystem(Text name) {
  return format("subsystem \"{}\" is not used, so it was not checked", name);
}
std::string subsystem_keeps_type() { return "the type of a subsystem cannot be set"; }
std::string no_parts(Text block) { return format("\"{}\" is a block without parts", block); }
std::string missing_parameter(Text block, Text type, Text parameter) {
  return format("{} needs a value for \"{}\": {} gives none", block, parameter, type);
}
std::string element_count(std::int64_t found, int limit) {
  return format("expected from 1 to {} elements, found {}", limit, found);
}
std::string no_elements() { return "expected at least one element, found an empty list"; }
std::string unit_count(std::size_t elements, std::size_t units) {
  return format("expected one unit, or one for each of {} elements, found {}", elements, units);
}
std::string port_direction(Text port, bool is_input) {
  return is_input ? format("{} is an input of this subsystem: inside, wires begin at it", port)
                  : format("{} is an output of this subsystem: inside, wires end at it", port);
}
std::string output_not_driven(Text port) { return format("output {} is not connected inside", port); }
std::string input_of_model_open(Text port) {
  return format("input {} has no default: this file runs as part of another model only", port);
}
std::string ports_in_a_circle(Text port) {
  return format("{} only passes its own value on, so nothing gives it one", port);
}

std::string unknown_unit(Text name) {
  return format("unknown unit \"{}\"{}", name, suggestion(name, unit_names()));
}
std::string expected_in_unit(Text expected) { return format("expected {}", expected); }
std::string celsius_in_compound() {
  return "degC stands only as a whole value, such as \"21 degC\"; use K in expressions and compound units";
}
std::string exponent_too_large() { return "an exponent of the unit is too large"; }
std::string unit_not_si(Text unit, const Dimension& dimension) {
  return format(
      "\"{}\" is not an SI unit: declare \"{}\" and write the unit into the value, such as "
      "value = \"5 {}\"",
      unit, to_string(dimension), unit);
}
std::string wrong_dimension(Text unit, const Dimension& declared, const Dimension& found) {
  const std::string base =
      to_string(declared) == unit || declared == Dimension{} ? "" : format(" ({})", to_string(declared));
  return format("expected {}{}, found {}", unit == "1" ? "a plain number" : unit, base, in_words(found));
}
std::string hertz_for_radians(Text unit) {
  return format("expected {}, found Hz, which lacks a factor of 2*pi: write \"2*pi*50 Hz\"", unit);
}
std::string unequal_dimensions(const Dimension& a, const Dimension& b) {
  return format("{} and {} cannot be added or compared", in_words(a), in_words(b));
}
std::string expected_plain_number(const Dimension& found) {
  return format("expected a plain number, found {}", in_words(found));
}

std::string unexpected(Text found) { return format("unexpected \"{}\"", found); }
std::string expression_ends() { return "the expression ends too early"; }
std::string expected_before(char expected, Text found) {
  return format("expected \"{}\": {}", expected, found);
}
std::string unknown_name(Text name, const Names& known) {
  return format("unknown name \"{}\"{}", name, suggestion(name, known));
}
std::string unknown_function(Text name, const Names& known) {
  return format("unknown function \"{}\"{}", name, suggestion(name, known));
}
std::string argument_count(Text function, int expected, int found) {
  return format("{} takes {} {}, found {}", function, expected, expected == 1 ? "argument" : "arguments",
                found);
}
std::string parameter_after_number(Text number, Text name) {
  return format("\"{1}\" is a parameter here, not a unit: write {0}*{1}, or give the parameter another name",
                number, name);
}
std::string number_out_of_reach() { return "this number is too large or too small for double precision"; }
std::string no_equality() { return "numbers are compared with <, <=, > and >= only"; }
std::string chained_comparison() { return "join two comparisons with \"and\""; }
std::string expected_number() {
  return "expected a number, found a condition; if(condition, a, b) makes a number of it";
}
std::string expected_condition() { return "expected a condition such as a > b, found a number"; }
std::string expression_too_deep() { return "the expression is nested too deeply"; }
std::string expression_too_long() { return "the expression is too long"; }
std::string not_finite(double value) {
  const Text found = std::isnan(value) ? "not a number" : value > 0.0 ? "infinite" : "minus infinite";
  return format("expected a finite number, but the value is {}", found);
}
std::string not_exact(Text expression) {
  return format("\"{}\" has no exact value: use whole numbers, decimals and fractions with + - * / ^",
                expression);
}
std::string not_whole(double value) { return format("expected a whole number, the value is {}", value); }

std::string unknown_parameter(Text name, const Names& known) {
  return format("there is no parameter \"{}\"{}", name, suggestion(name, known));
}
std::string cyclic_parameters(const Names& chain) {
  return format("parameters need each other: {}", fmt::join(chain, " -> "));
}
std::string out_of_range(Text name, double value, const Range& range, Text unit) {
  return format("{} is {}, expected {}", name, in_unit(value, unit), in_words(range, unit));
}
std::string not_increasing(Text name, double value, double before) {
  return format("{} is {}, expected more than the number before it, {}", name, value, before);
}
std::string range_of_two(std::size_t found) {
  return format("expected a range of two numbers, [lower, upper], found {}", found);
}
std::string range_reversed(double lower, double upper) {
  return format("the lower end of the range, {}, is above its upper end, {}", lower, upper);
}
std::string range_uses_parameters() { return "the ends of a range are numbers, not parameters"; }
std::string declared_here(Text name) { return format("\"{}\" is declared here", name); }

std::string unknown_type(Text name, const Names& known) {
  return format("unknown block type \"{}\"{}", name, suggestion(name, known));
}
std::string unknown_setting(Text name, Text type, const Names& known) {
  return format("{} has no parameter \"{}\"{}", type, name, suggestion(name, known));
}
std::string setting_of_other_structure(Text name, Text type) {
  return format("\"{}\" has no effect on this {}: its other settings leave it out", name, type);
}
std::string setting_refused(Text setting, Text reason) { return format("{}: {}", setting, reason); }
std::string block_refused(Text block, Text reason) { return format("{}: {}", block, reason); }
std::string empty_list() { return "expected at least one number, found an empty list"; }
std::string ragged_table(int expected, std::size_t found) {
  return format("expected {} numbers as in the first row, found {}", expected, found);
}

std::string expected_block() { return "expected the name of a block"; }
std::string unknown_block(Text name, const Names& known) {
  return format("there is no block \"{}\"{}", name, suggestion(name, known));
}
std::string unknown_port(Text block, Text port, bool is_input, const Names& known) {
  const std::string hint =
      known.empty() ? format("; it has no {}s", direction(is_input)) : suggestion(port, known);
  return format("{} has no {} \"{}\"{}", block, direction(is_input), port, hint);
}
std::string wrong_direction(Text block, Text port, bool wants_input, const Names& candidates) {
  const std::string list = candidates.empty()
                               ? format("it has no {}s", direction(wants_input))
                               : format("{}s: {}", direction(wants_input), fmt::join(candidates, ", "));
  return format("{}.{} is an {}, but {} an {}; {}", block, port, direction(!wants_input),
                wants_input ? "a wire ends at" : "this place wants", direction(wants_input), list);
}
std::string no_port(Text block, Text type, bool is_input) {
  return format("{} has no {}: it is a {}", block, direction(is_input), type);
}
std::string several_ports(Text block, Text type, bool is_input, const Names& ports) {
  return format("{} ({}) has several {}s, name one: {}", block, type, direction(is_input),
                fmt::join(ports, ", "));
}
std::string unknown_element(Text port, Text element, const Names& known) {
  if (known.empty()) return format("{} is a single number without elements", port);
  return format("{} has no element \"{}\"{}", port, element, suggestion(element, known));
}
std::string wire_without_arrow() { return "expected a wire such as \"a -> b\", found no ->"; }
std::string wire_too_long(std::size_t limit) {
  return format("the wire is longer than {} bytes; write several", limit);
}
std::string fan_out_inside_chain() { return "only the last part of a wire can name several inputs"; }
std::string object_and_number(Text from, Text to, bool to_number) {
  return format("{} carries {}, but {} takes {}", from, to_number ? "an object" : "numbers", to,
                to_number ? "numbers" : "an object");
}
std::string different_objects(Text from, Text to) {
  return format("{} and {} carry objects of different types", from, to);
}
std::string different_widths(Text from, int from_width, Text to, int to_width) {
  return format("{} has width {}, but {} has width {}", from, from_width, to, to_width);
}
std::string different_units(Text from, Text from_unit, Text to, Text to_unit) {
  return format("{} is in {}, but {} is in {}", from, from_unit, to, to_unit);
}
std::string block_of_type(Text block, Text type) {
  return format("\"{}\" is declared here, a {}", block, type);
}
std::string driven_twice(Text input) { return format("{} is driven by two wires", input); }
std::string first_wire_here() { return "the first wire is here"; }
std::string not_connected(Text input, Text unit, Text doc) {
  Names about;
  if (!doc.empty()) about.emplace_back(doc);
  if (unit != "any") about.push_back(format("in {}", unit));
  const std::string what = about.empty() ? "" : format(" ({})", fmt::join(about, ", "));
  return format("input {} is not connected{}", input, what);
}
std::string nothing_to_log(Text block) { return format("{} has no output that is a number", block); }
std::string logged_object(Text port) { return format("{} is an object; only numbers are logged", port); }

std::string not_one_number(Text port) {
  return format("{} is not one number: name one of its elements", port);
}

std::string unknown_choice(Text key, Text name, const Names& choices) {
  return format("unknown {} \"{}\"{}", key, name, suggestion(name, choices));
}

std::string unknown_method(Text name, const Names& known) {
  return format("unknown method \"{}\"{}", name, suggestion(name, known));
}
std::string discrete_with_states(const Names& states) {
  const std::string more = states.size() > 1 ? format(" and {} more", states.size() - 1) : "";
  return format("the method \"discrete\" integrates nothing, but there are continuous states: {}{}",
                states.front(), more);
}

std::string in_data_file(Text problem) { return std::string(problem); }

std::string file_too_large(std::size_t limit) {
  return format("the file is larger than {} GB", limit / 1'000'000'000);
}

std::string control_character(char found) {
  return format("the control character 0x{:02x} is not taken", static_cast<unsigned char>(found));
}

std::string csv_empty() { return "expected a header of column names, found an empty file"; }

std::string csv_without_rows() { return "expected a row of numbers after the header, found none"; }

std::string csv_row_width(int expected, int found) {
  return format("expected {} numbers, one for each column of the header, found {}", expected, found);
}

std::string csv_quote_inside() { return "a quote stands inside a field that does not begin with one"; }

std::string csv_quote_open() { return "the quote is not closed on its line"; }

std::string csv_after_quote() { return "expected a comma or the end of the line after the quote"; }

std::string csv_column_without_name() { return "expected the name of a column, found none"; }

std::string csv_column_twice(Text name) { return format("the column \"{}\" stands twice", name); }

std::string csv_not_finite(Text number) { return format("expected a finite number, found {}", number); }

std::string csv_not_a_number(Text field) {
  return field.empty() ? "expected a number, found nothing"
                       : format("expected a number, found \"{}\"", field);
}

std::string csv_time_alone() {
  return "expected a column of time and at least one more, separated by commas";
}

std::string csv_unknown_column(Text name, const Names& known) {
  if (name.empty()) return format("the file has several columns: name one of {}", fmt::join(known, ", "));
  return format("there is no column \"{}\"", name) + suggestion(name, known);
}

std::string csv_time_falls(double before, double after) {
  return format("time falls from {} s to {} s", before, after);
}

}  // namespace flyball::message
