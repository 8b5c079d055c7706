#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

/// The wording of what can be wrong with a study, beside what models say as well.
namespace flyball::message {

using Names = std::vector<std::string>;
using Text = std::string_view;

std::string in_model(Text message, Text model);
std::string model_and_models();
std::string no_models();
std::string model_named_twice(Text name);
std::string not_a_label(Text name);

// Settings.
std::string no_number_place(Text name);
std::string not_above_zero(double value, Text unit);
std::string set_twice(Text name);
std::string unknown_source(Text name, const Names& known);
std::string pick_without_front();

// Sweeps and samples.
std::string empty_values();
std::string points_or_step();
std::string point_count(double found, int limit);
std::string step_away(double from, double to);
std::string log_needs_one_side(double from, double to);
std::string log_without_step();
std::string unequal_axes(Text first, std::size_t count, Text other, std::size_t other_count);
std::string too_many_runs(std::int64_t limit);
std::string one_distribution(const Names& known);
std::string argument_list(Text distribution, Text wanted, std::size_t found);
std::string spread_not_positive(Text what, double found);
std::string not_in_order(Text first, double a, Text second, double b);
std::string difference_in_kelvin();
std::string nothing_within(double lower, double upper);
std::string no_truncation(Text distribution);
std::string spread_without_runs();
std::string too_many_for_sobol(std::size_t found, int limit);

// Fits, fronts and plots.
std::string bounds_equal(double value);
std::string bounds_needed(Text name);
std::string start_outside(double start, double lower, double upper);
std::string nothing_to_fit();
std::string nothing_to_match(Text experiment);
std::string data_before_start(double time);
std::string data_at_start_only();
std::string nothing_to_optimise();
std::string no_such_thing(Text kind, Text name, const Names& known);
std::string number_count(Text of, std::size_t wanted, std::size_t found);

}  // namespace flyball::message
