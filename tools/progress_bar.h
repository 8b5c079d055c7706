#pragma once

#include <chrono>
#include <string>

namespace flyball {

/// "[######----------]  38 %  0:12 left  76 of 200 runs": one line on standard error, drawn anew at most ten
/// times a second and wiped at the end.
class ProgressBar {
 public:
  /// Draws nothing when not `enabled`.
  explicit ProgressBar(bool enabled) : enabled_(enabled) {}
  ~ProgressBar() { wipe(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// `part` done, from 0 to 1, and what else there is to say.
  void show(double part, const std::string& note = {});
  void wipe();
  /// Begins to count time anew for work of which the part `from` is done already.
  void restart(double from);
  /// Since the start [s].
  double elapsed() const;

  /// The line after `elapsed` seconds of work from the part `from` on.
  static std::string line(double part, double elapsed, double from = 0.0);

 private:
  using Clock = std::chrono::steady_clock;

  bool enabled_;
  bool drawn_ = false;
  double from_ = 0.0;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_ = start_;
};

}  // namespace flyball
