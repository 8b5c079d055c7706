#pragma once

#include <ceres/jet.h>

#include "blocks/scalar.h"

namespace flyball {

inline double value_of(const Jet& x) { return x.a; }
inline bool nonzero(const Jet& x) { return x.a != 0.0; }

inline Jet select(bool on, const Jet& a, const Jet& b) { return on ? a : b; }
inline Jet select(bool on, const Jet& a, double b) { return on ? a : Jet(b); }
inline Jet select(bool on, double a, const Jet& b) { return on ? Jet(a) : b; }

inline Jet abs(const Jet& x) { return x.a < 0.0 ? -x : x; }
inline Jet min(const Jet& a, const Jet& b) { return b.a < a.a ? b : a; }
inline Jet max(const Jet& a, const Jet& b) { return a.a < b.a ? b : a; }
inline Jet wrap(const Jet& a) { return a + (std::remainder(a.a, 2.0 * M_PI) - a.a); }

}  // namespace flyball
