#include "tools/interrupt.h"

#include <atomic>

namespace flyball {
namespace {

/// Of the process; threads that work look at it.
std::atomic<int> received = 0;
static_assert(std::atomic<int>::is_always_lock_free);  // else a handler may not write it

void note(int number) { received = number; }

}  // namespace

InterruptWatch::InterruptWatch() {
  received = 0;
  struct sigaction action = {};
  action.sa_handler = note;
  action.sa_flags = SA_RESETHAND;
  sigemptyset(&action.sa_mask);
  ::sigaction(SIGINT, &action, &old_interrupt_);
  ::sigaction(SIGTERM, &action, &old_terminate_);
}

InterruptWatch::~InterruptWatch() {
  ::sigaction(SIGINT, &old_interrupt_, nullptr);
  ::sigaction(SIGTERM, &old_terminate_, nullptr);
}

int InterruptWatch::signal_number() { return received; }

}  // namespace flyball
