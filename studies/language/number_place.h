#pragma once

#include <optional>
#include <string>
#include <vector>

#include "models/language/names.h"
#include "models/plan.h"

namespace flyball {

/// What fits a parameter that a run can change without a new plan.
struct NumberPlace {
  std::string unit;  // "any" where the model does not say
  Range range;
};

/// That of "K", "motor.R" or "block.parameter"; nothing where there is none, where it fixes the structure,
/// and where it is computed from others.
std::optional<NumberPlace> number_place(const Plan& plan, const std::string& name);

/// Whether "block.key" is a key that fixes the shape of a block.
bool is_structure(const Plan& plan, const std::string& name);

/// The names of all places of numbers.
std::vector<std::string> number_places(const Plan& plan);

/// The parameters that an expression sees which stands where `name` is set.
NameIndex visible_parameters(const Diagram& diagram, std::string_view name);

}  // namespace flyball
