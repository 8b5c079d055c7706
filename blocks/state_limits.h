#pragma once

#include "blocks/handles.h"
#include "blocks/scalar.h"

namespace flyball {

/// Keeps a state between limits, of which either may be missing. At a limit the state rests while its free
/// rate (what it would be without limits) points outwards, and leaves when that changes sign. A state that
/// meets a limit, or starts beyond it, is set exactly onto it: rounding must not look like leaving.
struct StateLimits {
  State x;
  Param lower, upper;
  Relation at_lower, at_upper, growing;
  Crossing meets_lower, meets_upper;

  auto rate(auto& v, auto free) const {
    if (at_lower.declared())
      free = select(both(v.on(at_lower), opposite(v.on(growing))), v.number(0.0), free);
    if (at_upper.declared()) free = select(both(v.on(at_upper), v.on(growing)), v.number(0.0), free);
    return free;
  }
  void relations(auto& v, auto free) const {
    if (at_lower.declared()) v[at_lower] = v[lower] - v[x];
    if (at_upper.declared()) v[at_upper] = v[x] - v[upper];
    if (growing.declared()) v[growing] = free;
  }
  void crossings(auto& v) const {
    if (meets_lower.declared()) v[meets_lower] = v[x] - v[lower];
    if (meets_upper.declared()) v[meets_upper] = v[x] - v[upper];
  }
  void on_crossing(Crossing c, auto& v) const {
    if (c == meets_lower) v.next(x) = v[lower];
    if (c == meets_upper) v.next(x) = v[upper];
  }
};

}  // namespace flyball
