#pragma once
#include "blocks/state_space_terms.h"

namespace flyball {

struct StateSpace : StateSpaceTerms {
  static constexpr auto summary = "A linear system: x' = A x + B u, y = C x + D u.";
  static constexpr std::array aliases{"Modelica.Blocks.Continuous.StateSpace", "CLSS", "CLSS_f"};
  using StateSpaceTerms::StateSpaceTerms;
  States x = states("x", start(), "any", "state");

  void rates(auto& v) const {
    for (int i = 0; i < x.size(); ++i) v.rate(x[i]) = product(v, A, i, x) + product(v, B, i, u);
  }
  void outputs(auto& v) const {
    for (int i = 0; i < y.size(); ++i) v[y[i]] = product(v, C, i, x) + product(v, D, i, u);
  }
};

}  // namespace flyball
