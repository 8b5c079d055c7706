#pragma once

#include <chrono>
#include <string>

namespace flyball {

/// "[######----------]  38 %  0:12 left": one line on standard error, drawn anew at most ten times a second
/// and wiped at the end.
class ProgressBar {
 public:
  /// Draws nothing when not `enabled`.
  explicit ProgressBar(bool enabled) : enabled_(enabled) {}
  ~ProgressBar() { wipe(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// `part` done, from 0 to 1.
  void show(double part);
  void wipe();

  /// The line after `elapsed` seconds.
  static std::string line(double part, double elapsed);

 private:
  using Clock = std::chrono::steady_clock;

  bool enabled_;
  bool drawn_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_ = start_;
};

}  // namespace flyball
