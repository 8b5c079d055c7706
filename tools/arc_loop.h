#pragma once

#include "models/plan.h"
#include "solvers/log.h"

namespace flyball {

// The loop of models/line_arc/arc_error_loop.toml (Ma, Liu, Yu, Cao 2018, eq. 24): what a run of it shows,
// and what the closed forms of its linearisation s^2 + a s + b = 0, a = 2 V K_gamma/L, b = 2 V^2 K_H/L, say.

inline constexpr double arc_horizon = 40.0;  // s
/// Fine enough that a peak between two rows is missed by less than 1e-5 of its height.
inline const Rational arc_log_interval = *Rational::fraction(1, 200);  // s

/// SI; the loop starts at the distance H0, with the heading of the arc.
struct ArcLoop {
  double V, L, K_H, K_gamma, H0;

  double a() const { return 2.0 * V * K_gamma / L; }
  double b() const { return 2.0 * V * V * K_H / L; }
};

struct ArcMeasures {
  double damping = 0.0;
  double overshoot = 0.0;  // % of H0
  double settling = 0.0;   // to 2 % of H0, s
  double ise = 0.0;        // integral of H^2, m^2 s
};

/// The parameters that a plan of the model runs with.
ArcLoop arc_loop_of(const Plan& plan);

/// H of the linearised loop at time t.
double linear_distance(const ArcLoop& loop, double t);

ArcMeasures linear_response(const ArcLoop& loop);

/// Measured on the column H of a log; the damping cannot be read off a log and is 0.
ArcMeasures measure(const Log& log);

}  // namespace flyball
