#include "tools/progress_bar.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/console.h"

namespace flyball {
namespace {

constexpr int width = 32;
constexpr std::chrono::milliseconds between(100);

}  // namespace

std::string ProgressBar::line(double part, double elapsed, double from) {
  const double done = std::clamp(part, 0.0, 1.0);
  const int filled = static_cast<int>(done * width);
  std::string text =
      fmt::format("[{:#<{}}{:-<{}}] {:3.0f} %", "", filled, "", width - filled, std::floor(100.0 * done));
  if (done <= from) return text;
  // A day is the longest time that anybody waits for a bar.
  const auto left = static_cast<long>(std::min(elapsed * (1.0 - done) / (done - from), 86400.0));
  return text + fmt::format("  {}:{:02} left", left / 60, left % 60);
}

void ProgressBar::show(double part, const std::string& note) {
  if (!enabled_) return;
  const Clock::time_point now = Clock::now();
  if (now - last_ < between) return;
  last_ = now;
  drawn_ = true;
  complain("\r\x1b[K" + line(part, elapsed(), from_) + (note.empty() ? "" : "  ") + note);
}

void ProgressBar::restart(double from) {
  from_ = from;
  start_ = Clock::now();
}

double ProgressBar::elapsed() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

void ProgressBar::wipe() {
  if (drawn_) complain("\r\x1b[K");
  drawn_ = false;
}

}  // namespace flyball
