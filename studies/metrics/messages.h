#pragma once

#include <string>
#include <string_view>
#include <vector>

/// The wording of what can be wrong with a metric or a requirement, besides what can be wrong with any
/// expression.
namespace flyball::message {

std::string changes_over_time(std::string_view signal);
std::string series_not_number(std::string_view signature);
std::string takes(std::string_view signature, std::size_t found);
std::string missing_argument(std::string_view signature, std::string_view parameter);
std::string unknown_argument(std::string_view signature, std::string_view name,
                             const std::vector<std::string>& known);
std::string argument_twice(std::string_view name);
std::string expected_file();
std::string in_file(std::string_view problem);
std::string nested_too_deeply();

std::string expected_relation();
std::string expected_window(std::string_view word);
std::string different_clauses(std::string_view first, std::string_view other);
std::string expected_tolerance(std::string_view found);
std::string expected_literal();
std::string tolerance_negative(std::string_view name);
std::string relative_too_large();
std::string column_dimension(std::string_view wanted, std::string_view found);
std::string envelope_without_bounds();
std::string envelope_units();
std::string envelope_reversed(double time);

}  // namespace flyball::message
