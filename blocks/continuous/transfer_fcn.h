#pragma once
#include <algorithm>

#include "blocks/block.h"

namespace flyball {

struct TransferFcn : Block {
  static constexpr auto summary = "A rational transfer function, numerator(s)/denominator(s).";
  static constexpr std::array aliases{"Modelica.Blocks.Continuous.TransferFunction", "CLR", "CLR_f"};
  Coefficients numerator =
      coefficients("numerator", {1.0}, "any", "coefficient of the numerator, highest power of s first");
  Coefficients denominator = coefficients("denominator", {1.0, 1.0}, "any",
                                          "coefficient of the denominator, highest power of s first");
  int order = std::max(denominator.columns() - 1, 0);
  int excess = order - (numerator.columns() - 1);
  Input u = input("u", "any", "signal");
  Output y = output("y", "any", "filtered signal");
  States x = states("x", order, "any", "derivative of the filtered input: x1 of order n-1, xn of order 0");

  explicit TransferFcn(Settings* settings) : Block(settings) {
    if (denominator.columns() == 0 || denominator.row(0).empty() || denominator.row(0)[0].column != 0) {
      refuse("denominator", "expected a first coefficient that is not 0");
    } else if (numerator.row(0).empty()) {
      refuse("numerator", "expected a coefficient that is not 0");
    } else if (numerator.row(0)[0].column + excess < 0) {
      refuse("numerator", "expected an order of at most " + std::to_string(order) +
                              ", that of the denominator, found " +
                              std::to_string(numerator.columns() - 1 - numerator.row(0)[0].column));
    }
  }

  // Controllable canonical form. With z = u/denominator(s) and x_k = z^(n-k):
  //   a_0 z^(n) + a_1 x_1 + … + a_n x_n = u,   y = b_0 z^(n) + b_1 x_1 + … + b_n x_n
  void rates(auto& v) const {
    for (int k = 0; k < order; ++k) v.rate(x[k]) = k == 0 ? highest(v) : v[x[k - 1]];
  }
  void outputs(auto& v) const {
    auto sum = v.number(0.0);
    for (const auto& b : numerator.row(0)) {
      const int k = b.column + excess;
      sum += v[b.param] * (k == 0 ? highest(v) : v[x[k - 1]]);
    }
    v[y] = sum;
  }

 private:
  auto highest(auto& v) const {
    auto rest = v[u];
    for (const auto& a : denominator.row(0).subspan(1)) rest -= v[a.param] * v[x[a.column - 1]];
    return rest / v[denominator.row(0)[0].param];
  }
};

}  // namespace flyball
