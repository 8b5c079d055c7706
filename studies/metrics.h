#pragma once

#include <span>

namespace flyball {

/// A signal on a grid of times [s] that never falls; two values at one time are a jump.
struct Signal {
  std::span<const double> time;
  std::span<const double> value;
};

// How a signal goes from `initial` to `final`. Its way is w = (e - initial) / (final - initial), from 0 to 1.
// Between grid points a signal is taken as straight. NaN where there is no answer.

/// How far it goes beyond its end, in percent of the way; 0 if it does not.
double overshoot(const Signal& signal, double initial, double final);

/// From the start to the last time at which |e - final| leaves `band` |final - initial|. NaN when it is
/// outside at the end of the grid: it did not settle within the horizon.
double settling_time(const Signal& signal, double initial, double final, double band = 0.02);

/// From the first time at w = 0.1 to the first at w = 0.9. NaN when it does not get there.
double rise_time(const Signal& signal, double initial, double final);

/// Integrals of (e - final)^2 and |e - final| by the trapezoidal rule on the grid.
double integral_of_square(const Signal& signal, double final = 0.0);
double integral_of_magnitude(const Signal& signal, double final = 0.0);

}  // namespace flyball
