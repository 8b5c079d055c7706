#pragma once
#include "blocks/block.h"
#include "blocks/root_factors.h"

namespace flyball {

/// A chain of sections of second order, and one of first order where the order is odd: unlike one polynomial
/// it does not lose the poles of a high order to rounding.
struct ZeroPole : Block {
  static constexpr auto summary = "A transfer function given by its zeros, poles and gain.";
  Coefficients real_zeros = coefficients("zeros", {}, "any", "real zero");
  Coefficients complex_zeros =
      matrix("complex_zeros", {}, "[re, im] of a pair of zeros re + im j, re - im j");
  Coefficients real_poles = coefficients(
      "poles", given("complex_poles") ? std::vector<double>{} : std::vector{-1.0}, "any", "real pole");
  Coefficients complex_poles =
      matrix("complex_poles", {}, "[re, im] of a pair of poles re + im j, re - im j");
  Param gain = param("gain", 1.0, "any", any, "factor");
  int order = real_poles.columns() + 2 * complex_poles.rows();
  Input u = input("u", "any", "signal");
  Output y = output("y", "any", "filtered signal");
  States x =
      states("x", order, "any", "states of the sections: derivative and value of what its poles filtered");

  explicit ZeroPole(Settings* settings) : Block(settings) {
    const int count = real_zeros.columns() + 2 * complex_zeros.rows();
    for (const auto& [key, pairs] :
         {std::pair{"complex_zeros", &complex_zeros}, {"complex_poles", &complex_poles}}) {
      if (pairs->rows() > 0 && pairs->columns() != 2) refuse(key, "expected pairs [re, im]");
    }
    if (count > order) {
      refuse(given("zeros") ? "zeros" : "complex_zeros", "expected at most " + std::to_string(order) +
                                                             ", the number of poles, found " +
                                                             std::to_string(count));
    }
  }

  void rates(auto& v) const {
    auto signal = v[gain] * v[u];
    for (int first = 0; first < order; first += 2) {
      v.rate(x[first]) = highest(v, first, signal);
      if (first + 1 < order) v.rate(x[first + 1]) = v[x[first]];
      signal = section(v, first, signal);
    }
  }
  void outputs(auto& v) const {
    auto signal = v[gain] * v[u];
    for (int first = 0; first < order; first += 2) signal = section(v, first, signal);
    v[y] = signal;
  }

 private:
  // Section k has the poles of factor k and its zeros, if there are so many.
  std::vector<RootFactor> zeros = root_factors(real_zeros, complex_zeros);
  std::vector<RootFactor> poles = root_factors(real_poles, complex_poles);

  /// Of the section whose states begin at `first`: its highest derivative. With w = input / poles(s), its
  /// states are w' and w, or w alone.
  auto highest(auto& v, int first, const auto& input) const {
    const RootFactor& pole = poles[first / 2];
    if (pole.linear()) return input - pole.constant(v) * v[x[first]];
    return input - pole.first(v) * v[x[first]] - pole.constant(v) * v[x[first + 1]];
  }
  /// Its output, zeros(s) w.
  auto section(auto& v, int first, const auto& input) const {
    const int k = first / 2, last = poles[k].linear() ? first : first + 1;
    auto result = v.number(0.0);
    if (k >= static_cast<int>(zeros.size())) return result + v[x[last]];
    const RootFactor& zero = zeros[k];
    const bool proper = poles[k].linear() || !zero.linear();
    result += proper ? highest(v, first, input) : v[x[first]];
    if (!zero.linear()) result += zero.first(v) * v[x[first]];
    return result + zero.constant(v) * v[x[last]];
  }
};

}  // namespace flyball
