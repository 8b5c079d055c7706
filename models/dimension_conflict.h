#pragma once

#include <optional>
#include <vector>

#include "models/signal_dimensions.h"

namespace flyball {

/// A unit, or a factor without one, that takes part in a contradiction.
struct Suspect {
  int equation = -1;
  LinearForm unit;    // what it is, in base units
  LinearForm needed;  // what the other equations of the contradiction make of it
  int remaining = 0;  // contradictions in the diagram that are left without it
};

/// Equations that contradict each other, of which none can be missed.
struct Conflict {
  std::vector<int> equations;
  std::vector<Suspect> suspects;  // the likeliest first: those that alone settle the most
  bool settled = false;           // whether without the first suspect fewer contradictions are left
};

/// Finds what is wrong in the equations `active`, given in order of precedence, of which those in the places
/// `contradictions` contradict those before them. Looks near the first of these, so that the result is short;
/// without suspects when there is none.
Conflict find_conflict(const SignalEquations& equations, const std::vector<int>& active,
                       const std::vector<int>& contradictions);

}  // namespace flyball
