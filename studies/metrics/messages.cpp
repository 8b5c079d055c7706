#include "studies/metrics/messages.h"

#include <fmt/format.h>

#include "models/language/nearest.h"

namespace flyball::message {

using fmt::format;

std::string changes_over_time(std::string_view signal) {
  return format("{0} changes over time: say which number of it is meant, such as final({0}) or max({0})",
                signal);
}
std::string series_not_number(std::string_view signature) {
  return format("{} changes over time: say which number of it is meant, such as max(…) or rms(…)", signature);
}
std::string takes(std::string_view signature, std::size_t found) {
  return format("too many arguments: expected {}, found {}", signature, found);
}
std::string missing_argument(std::string_view signature, std::string_view parameter) {
  return format("{} is missing in {}", parameter, signature);
}
std::string unknown_argument(std::string_view signature, std::string_view name,
                             const std::vector<std::string>& known) {
  const auto meant = nearest(name, known);
  return format("{} has no argument \"{}\"{}", signature, name,
                meant ? format("; did you mean \"{}\"?", *meant) : "");
}
std::string argument_twice(std::string_view name) { return format("{} is given twice", name); }
std::string expected_file() { return "expected the name of a CSV file in quotes"; }
std::string in_file(std::string_view problem) { return format("the file does not serve: {}", problem); }
std::string nested_too_deeply() { return "calls are nested too deeply"; }

std::string expected_relation() {
  return "expected a comparison with <, <=, > or >=, or \"within\" or \"matches\" and a file";
}
std::string expected_window(std::string_view word) {
  return format("expected \"and\" and the end of the time behind \"{}\"", word);
}
std::string different_clauses(std::string_view first, std::string_view other) {
  return format("this statement is about {}, the first one about {}: make them two requirements", other,
                first);
}
std::string expected_tolerance(std::string_view found) {
  return format("expected absolute, relative, time or column, found \"{}\"", found);
}
std::string expected_literal() { return "expected a number with its unit"; }
std::string tolerance_negative(std::string_view name) { return format("the {} tolerance is below 0", name); }
std::string relative_too_large() { return "the relative tolerance must be below 100 %"; }
std::string column_dimension(std::string_view wanted, std::string_view found) {
  return format("the signal is in {}, the column of the file in {}", wanted, found);
}
std::string envelope_without_bounds() {
  return "an envelope has the columns time, lower and upper, or one of the two";
}
std::string envelope_units() { return "lower and upper have different units"; }
std::string envelope_reversed(double time) { return format("lower is above upper at {} s", time); }

}  // namespace flyball::message
