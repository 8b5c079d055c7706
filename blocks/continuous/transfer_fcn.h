#pragma once
#include "blocks/transfer_terms.h"

namespace flyball {

struct TransferFcn : TransferTerms {
  static constexpr auto summary = "A rational transfer function, numerator(s)/denominator(s).";
  static constexpr std::array aliases{"Modelica.Blocks.Continuous.TransferFunction", "CLR", "CLR_f"};
  explicit TransferFcn(Settings* settings) : TransferTerms(settings, "s") {}
  States x = states("x", order, "any", "derivative of the filtered input: x1 of order n-1, xn of order 0");

  void rates(auto& v) const {
    for (int k = 0; k < order; ++k) v.rate(x[k]) = advanced(v, x, k);
  }
  void outputs(auto& v) const { v[y] = filtered(v, x); }
};

}  // namespace flyball
