#pragma once
#include <algorithm>

#include "blocks/block.h"

namespace flyball {

/// What the continuous and the sampled transfer function have in common, in controllable canonical form. With
/// q = s or z, w = u/denominator(q) and the memory x_k = q^(n-k) w:
///   a_0 q^n w + a_1 x_1 + … + a_n x_n = u,   y = b_0 q^n w + b_1 x_1 + … + b_n x_n
struct TransferTerms : Block {
  std::string variable;
  Coefficients numerator = coefficients(
      "numerator", {1.0}, "any", "coefficient of the numerator, highest power of " + variable + " first");
  Coefficients denominator =
      coefficients("denominator", {1.0, variable == "z" ? -0.5 : 1.0}, "any",
                   "coefficient of the denominator, highest power of " + variable + " first");
  int order = std::max(denominator.columns() - 1, 0);
  int excess = order - (numerator.columns() - 1);
  Input u = input("u", "any", "signal");
  Output y = output("y", "any", "filtered signal");

  TransferTerms(Settings* settings, std::string symbol) : Block(settings), variable(std::move(symbol)) {
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

 protected:
  /// q times x_k, k counted from 0.
  auto advanced(auto& v, const auto& x, int k) const { return k == 0 ? highest(v, x) : v[x[k - 1]]; }
  auto filtered(auto& v, const auto& x) const {
    auto sum = v.number(0.0);
    for (const auto& b : numerator.row(0)) sum += v[b.param] * advanced(v, x, b.column + excess);
    return sum;
  }

 private:
  auto highest(auto& v, const auto& x) const {
    auto rest = v[u];
    for (const auto& a : denominator.row(0).subspan(1)) rest -= v[a.param] * v[x[a.column - 1]];
    return rest / v[denominator.row(0)[0].param];
  }
};

}  // namespace flyball
