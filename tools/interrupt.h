#pragma once

#include <csignal>

namespace flyball {

/// While it lives, Ctrl-C (SIGINT) and SIGTERM are noted instead of ending the process, so that results can
/// be written. The second signal ends it.
class InterruptWatch {
 public:
  InterruptWatch();
  ~InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;

  /// The number of the signal that came; 0 if none.
  static int signal_number();

 private:
  struct sigaction old_interrupt_ = {}, old_terminate_ = {};
};

}  // namespace flyball
