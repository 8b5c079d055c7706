#include "studies/language/study_messages.h"

#include <fmt/format.h>

#include "models/language/nearest.h"

namespace flyball::message {
namespace {

using fmt::format;

std::string suggestion(Text name, const Names& known) {
  if (known.empty()) return "; there is none";
  if (const auto meant = nearest(name, known)) return format("; did you mean \"{}\"?", *meant);
  return format("; known: {}", fmt::join(known, ", "));
}

std::string in_unit(double value, Text unit) {
  return unit == "any" || unit == "1" ? format("{}", value) : format("{} {}", value, unit);
}

}  // namespace

std::string in_model(Text message, Text model) { return format("{} (in the model {})", message, model); }
std::string model_and_models() { return "give either \"model\" or \"models\""; }
std::string no_models() { return "expected at least one model, found none"; }
std::string model_named_twice(Text name) {
  return format("two models are named \"{0}\": write models = {{ {0} = \"…\", other = \"…\" }}", name);
}
std::string not_a_label(Text name) {
  return name.empty() ? "expected a name, found an empty text" : "a name has no control characters";
}

std::string no_number_place(Text name) {
  return format(
      "{} fixes the structure of the model, or is computed from other parameters: cases, scenarios and "
      "sweeps set it, "
      "nothing else does",
      name);
}
std::string not_above_zero(double value, Text unit) {
  return format("expected a value above 0, found {}", in_unit(value, unit));
}
std::string set_twice(Text name) { return format("\"{}\" is set twice here", name); }
std::string unknown_source(Text name, const Names& known) {
  return format("there is no \"{}\" to take values from", name) + suggestion(name, known);
}
std::string pick_without_front() { return "\"pick\" chooses a point of a front: from = \"pareto.…\""; }

std::string empty_values() { return "expected at least one value, found an empty list"; }
std::string points_or_step() { return "give either \"points\" or \"step\""; }
std::string point_count(double found, int limit) {
  return format("expected from 1 to {} points, found {}", limit, found);
}
std::string step_away(double from, double to) {
  return format("with this step, {} never comes to {}", from, to);
}
std::string log_needs_one_side(double from, double to) {
  return format("a logarithmic range lies on one side of 0, found {} to {}", from, to);
}
std::string log_without_step() { return "a logarithmic range takes \"points\", not \"step\""; }
std::string unequal_axes(Text first, std::size_t count, Text other, std::size_t other_count) {
  return format("combine = \"zip\" needs as many values of each: {} has {}, {} has {}", first, count, other,
                other_count);
}
std::string too_many_runs(std::int64_t limit) { return format("this takes the study beyond {} runs", limit); }
std::string one_distribution(const Names& known) {
  return format("expected one distribution: {}", fmt::join(known, ", "));
}
std::string argument_list(Text distribution, Text wanted, std::size_t found) {
  return format("{} takes {}, found {} values", distribution, wanted, found);
}
std::string spread_not_positive(Text what, double found) {
  return format("expected {}, found {}", what, found);
}
std::string not_in_order(Text first, double a, Text second, double b) {
  return format("the {}, {}, is not below the {}, {}", first, a, second, b);
}
std::string difference_in_kelvin() { return "a difference of temperatures is in K, not in degC"; }
std::string nothing_within(double lower, double upper) {
  return format("no part of the distribution lies from {} to {}", lower, upper);
}
std::string no_truncation(Text distribution) {
  return format("{} has ends of its own: \"within\" is for normal and lognormal", distribution);
}
std::string spread_without_runs() { return "[monte_carlo] has no \"runs\""; }
std::string too_many_for_sobol(std::size_t found, int limit) {
  return format("sampling = \"sobol\" takes up to {} parameters, found {}; take \"latin_hypercube\"", limit,
                found);
}

std::string bounds_equal(double value) {
  return format("both bounds are {}: nothing is left to find", value);
}
std::string bounds_needed(Text name) { return format("{} needs bounds, [lower, upper]", name); }
std::string start_outside(double start, double lower, double upper) {
  return format("the start, {}, is outside of the bounds, {} to {}", start, lower, upper);
}
std::string nothing_to_fit() {
  return "nothing to fit to: give \"experiments\", \"requirements\" or \"minimise\"";
}
std::string nothing_to_match(Text experiment) {
  return format("experiment {} has data, but no \"match\" such as {{ y = \"y\" }}", experiment);
}
std::string data_before_start(double time) {
  return format("the data begin at {} s, before the run, which begins at 0 s", time);
}

std::string data_at_start_only() { return "all data are at 0 s: nothing has happened there"; }

std::string nothing_to_optimise() { return "nothing to optimise: give \"minimise\" or \"maximise\""; }
std::string no_such_thing(Text kind, Text name, const Names& known) {
  return format("there is no {} \"{}\"", kind, name) + suggestion(name, known);
}
std::string number_count(Text of, std::size_t wanted, std::size_t found) {
  return format("expected {} numbers, one for each {}, found {}", wanted, of, found);
}

}  // namespace flyball::message
