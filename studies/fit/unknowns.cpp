#include "studies/fit/unknowns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "models/language/messages.h"
#include "solvers/parameters.h"
#include "studies/fit/fit.h"
#include "studies/language/study_messages.h"
#include "studies/parameter_unit.h"

namespace flyball {
namespace {

/// Ceres knows closed bounds alone: an open end is left by this part of the scale.
constexpr double inside = 1e-9;

void narrow(Range& range, const Range& other) {
  if (other.lower > range.lower || (other.lower == range.lower && other.lower_open)) {
    range.lower = other.lower;
    range.lower_open = other.lower_open;
  }
  if (other.upper < range.upper || (other.upper == range.upper && other.upper_open)) {
    range.upper = other.upper;
    range.upper_open = other.upper_open;
  }
}

/// What the declaration of a parameter, and of each block parameter that repeats it, allows.
Range range_of(const Plan& plan, int slot) {
  Range range;
  const std::vector<Parameter>& parameters = plan.diagram->parameters;
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    if (plan.model_slots[p] == slot) narrow(range, parameters[p].range);
  }
  for (int i = 0; i < static_cast<int>(plan.diagram->instances.size()); ++i) {
    for (const auto& [local, binding] : plan.instance(i).parameters) {
      if (plan.index_of(i)[local] == slot)
        narrow(range, plan.instance(i).object->specification->slots[local].range);
    }
  }
  return range;
}

std::vector<std::string> settable_names(const Plan& plan) {
  std::vector<std::string> names;
  for (const Start& literal : plan.literals) {
    const std::string name = plan.slot_name(literal.slot);
    if (plan.parameter_slot(name) == literal.slot) names.push_back(name);  // a sample time has no name
  }
  return names;
}

double scale_of(const Sought& sought, double start) {
  if (sought.scale > 0.0) return sought.scale;
  if (start != 0.0) return std::fabs(start);
  const double width = sought.upper - sought.lower;
  return std::isfinite(width) && width > 0.0 ? 0.5 * width : 1.0;
}

void require_bounds(const Sought& sought) {
  if (sought.lower < sought.upper) return;
  throw std::invalid_argument(fmt::format("{}: {}", sought.name,
                                          sought.lower == sought.upper
                                              ? message::bounds_equal(sought.lower)
                                              : message::range_reversed(sought.lower, sought.upper)));
}

/// Throws std::invalid_argument with what is wrong.
Unknown unknown_of(const Sought& sought, const Plan& plan) {
  if (plan.parameter_slot(sought.name) < 0)
    throw std::invalid_argument(message::unknown_parameter(sought.name, settable_names(plan)));
  const int slot = settable_parameter(plan, sought.name);
  const double start = sought.start.value_or(std::ranges::find(plan.literals, slot, &Start::slot)->value);
  Unknown unknown{sought.name,  parameter_unit(plan, sought.name),
                  start,        sought.lower,
                  sought.upper, scale_of(sought, start)};
  require_bounds(sought);
  const Range range = range_of(plan, slot);
  if (!range.contains(start))
    throw std::invalid_argument(message::out_of_range(sought.name, start, range, unknown.unit));
  if (!(sought.lower <= start && start <= sought.upper))
    throw std::invalid_argument(
        fmt::format("{}: {}", sought.name, message::start_outside(start, sought.lower, sought.upper)));
  const double margin = inside * unknown.scale;
  unknown.lower = std::max(unknown.lower, range.lower + (range.lower_open ? margin : 0.0));
  unknown.upper = std::min(unknown.upper, range.upper - (range.upper_open ? margin : 0.0));
  return unknown;
}

}  // namespace

double Unknown::difference_step(double value) const { return 3e-4 * std::max(std::fabs(value), 0.1 * scale); }

std::vector<Unknown> unknowns_of(const std::vector<Sought>& sought, const Plan& plan,
                                 const std::string& prefix) {
  std::vector<Unknown> unknowns;
  std::string wrong;
  const auto complain = [&](const std::string& what) {
    wrong += fmt::format("{}{}{}", wrong.empty() ? "" : "\n", prefix, what);
  };
  if (sought.empty()) complain("there is no parameter to fit");
  for (const Sought& one : sought) {
    try {
      if (std::ranges::find(unknowns, one.name, &Unknown::name) != unknowns.end())
        throw std::invalid_argument(fmt::format("{} is sought twice", one.name));
      unknowns.push_back(unknown_of(one, plan));
    } catch (const std::invalid_argument& error) {
      complain(error.what());
    }
  }
  if (!wrong.empty()) throw FitError(wrong);
  return unknowns;
}

}  // namespace flyball
