#pragma once

#include <array>
#include <vector>

namespace flyball {

/// The logged signals inside one step, where they are affine in the states and the continuous extension is a
/// polynomial of at most fourth degree in time: five samples then give all others, for four multiplications
/// each. Newton's form on five equal distances; a constant stays exactly constant.
class LogPolynomial {
 public:
  explicit LogPolynomial(int width) : width_(width), differences_(static_cast<std::size_t>(points * width)) {}

  /// `sample(t, row)` gives the signals at a time of the step.
  template <class Sample>
  void fit(double begin, double end, Sample&& sample);
  void evaluate(double t, double* row) const;

 private:
  static constexpr int points = 5;
  static constexpr double distance = 1.0 / (points - 1);

  double* row(int k) { return differences_.data() + k * width_; }
  const double* row(int k) const { return differences_.data() + k * width_; }

  int width_;
  std::vector<double> differences_;  // divided differences, by order
  double begin_ = 0.0, scale_ = 0.0;
};

template <class Sample>
void LogPolynomial::fit(double begin, double end, Sample&& sample) {
  begin_ = begin;
  scale_ = 1.0 / (end - begin);
  for (int k = 0; k < points; ++k)
    sample(k + 1 == points ? end : begin + k * distance * (end - begin), row(k));
  for (int order = 1; order < points; ++order) {
    for (int k = points - 1; k >= order; --k) {
      for (int c = 0; c < width_; ++c) row(k)[c] = (row(k)[c] - row(k - 1)[c]) / (order * distance);
    }
  }
}

inline void LogPolynomial::evaluate(double t, double* y) const {
  const double s = (t - begin_) * scale_;
  const double* d = differences_.data();
  for (int c = 0; c < width_; ++c, ++d) {
    const double inner = d[3 * width_] + (s - 3.0 * distance) * d[4 * width_];
    y[c] = d[0] + s * (d[width_] + (s - distance) * (d[2 * width_] + (s - 2.0 * distance) * inner));
  }
}

}  // namespace flyball
