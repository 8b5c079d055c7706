#pragma once
#include "blocks/state_space_terms.h"

namespace flyball {

struct DiscreteStateSpace : StateSpaceTerms {
  static constexpr auto summary =
      "A sampled linear system: x(k+1) = A x(k) + B u(k), y(k) = C x(k) + D u(k).";
  static constexpr std::array aliases{"Modelica.Blocks.Discrete.StateSpace", "DLSS", "DLSS_f"};
  using StateSpaceTerms::StateSpaceTerms;
  SampleTime ts = sample_time();
  Helds x = helds("x", start(), "any", "state at the next hit");

  void outputs(auto& v) const {
    for (int i = 0; i < y.size(); ++i) v[y[i]] = product(v, C, i, x) + product(v, D, i, u);
  }
  void on_sample(auto& v) const {
    for (int i = 0; i < x.size(); ++i) v.next(x[i]) = product(v, A, i, x) + product(v, B, i, u);
  }
};

}  // namespace flyball
