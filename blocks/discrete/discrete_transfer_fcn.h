#pragma once
#include "blocks/transfer_terms.h"

namespace flyball {

struct DiscreteTransferFcn : TransferTerms {
  static constexpr auto summary = "A sampled transfer function, numerator(z)/denominator(z).";
  static constexpr std::array aliases{"Modelica.Blocks.Discrete.TransferFunction", "DLR", "DLR_f"};
  explicit DiscreteTransferFcn(Settings* settings) : TransferTerms(settings, "z") {}
  SampleTime ts = sample_time();
  Helds x = helds("x", std::vector<Param>(order), "any",
                  "input through 1/denominator(z): x1 at the last hit, xn at n hits before");

  void outputs(auto& v) const { v[y] = filtered(v, x); }
  void on_sample(auto& v) const {
    for (int k = 0; k < order; ++k) v.next(x[k]) = advanced(v, x, k);
  }
};

}  // namespace flyball
