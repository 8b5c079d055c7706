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

/// From the start to the first time at w = `level`. NaN when it does not get there.
double time_to(const Signal& signal, double initial, double final, double level);

/// The value farthest from `initial`, and the time from the start to the first time there.
double peak(const Signal& signal, double initial);
double peak_time(const Signal& signal, double initial);

// Integrals by the trapezoidal rule on the grid: a jump has no width, and no area.
double integral(const Signal& signal);
/// Of (e - final)^2 and |e - final|.
double integral_of_square(const Signal& signal, double final = 0.0);
double integral_of_magnitude(const Signal& signal, double final = 0.0);
/// Of t |e| and t e^2, where t counts from the start.
double integral_of_time_magnitude(const Signal& signal);
double integral_of_time_square(const Signal& signal);

/// Means over time. Of a signal without duration, its last value.
double mean(const Signal& signal);
double root_mean_square(const Signal& signal);

/// The value at a time; behind a jump there. NaN outside the grid.
double value_at(const Signal& signal, double time);

/// The sum of |e[k+1] - e[k]|, jumps included.
double total_variation(const Signal& signal);
/// How often the signal changes its sign; a zero has none.
double crossings(const Signal& signal);
/// The length of the way of a point with these coordinates, on one grid.
double path_length(const Signal& x, const Signal& y);

}  // namespace flyball
