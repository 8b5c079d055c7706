#pragma once

namespace flyball {

/// Weights of cubic Hermite interpolation at theta of a step of size h:
/// x = before x0 + after x1 + h (rate_before x0' + rate_after x1'). Exact at both ends, rounding included.
/// Source: Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, 2nd ed., eq. II.6.7.
template <class T>
struct HermiteWeights {
  T before, after, rate_before, rate_after;

  explicit HermiteWeights(const T& theta)
      : before((1.0 + 2.0 * theta) * (1.0 - theta) * (1.0 - theta)),
        after(theta * theta * (3.0 - 2.0 * theta)),
        rate_before(theta * (1.0 - theta) * (1.0 - theta)),
        rate_after(-(theta * theta * (1.0 - theta))) {}
};

}  // namespace flyball
