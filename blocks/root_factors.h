#pragma once

#include <vector>

#include "blocks/handles.h"

namespace flyball {

/// s^2 + first s + constant, or s + constant: a factor of a polynomial that is given by its roots.
struct RootFactor {
  enum class Kind { complex_pair, real_pair, single } kind;
  Param a, b;  // re and im; two real roots; one root

  bool linear() const { return kind == Kind::single; }
  auto first(auto& v) const {
    return kind == Kind::complex_pair ? -2.0 * v.number(a) : -(v.number(a) + v.number(b));
  }
  auto constant(auto& v) const {
    if (linear()) return -v.number(a);
    const auto cross = v.number(b) * (kind == Kind::complex_pair ? v.number(b) : v.number(a));
    return kind == Kind::complex_pair ? v.number(a) * v.number(a) + cross : cross;
  }
};

/// The factors of the real roots in one row, and of the pairs [re, im] in many: those of first order last.
inline std::vector<RootFactor> root_factors(const Coefficients& real, const Coefficients& complex) {
  std::vector<RootFactor> factors;
  for (int r = 0; r < complex.rows() && complex.columns() == 2; ++r) {
    const std::vector<Param> root = complex.params(r);
    factors.push_back({RootFactor::Kind::complex_pair, root[0], root[1]});
  }
  const std::vector<Param> roots = real.params(0);
  std::size_t k = 0;
  for (; k + 1 < roots.size(); k += 2)
    factors.push_back({RootFactor::Kind::real_pair, roots[k], roots[k + 1]});
  if (k < roots.size()) factors.push_back({RootFactor::Kind::single, roots[k], {}});
  return factors;
}

}  // namespace flyball
