#include <atomic>
#include <cstdlib>
#include <new>

#include "solvers/stepper.h"
#include "tests/catch.h"
#include "tests/solvers/stiff_systems.h"

using namespace flyball;
using namespace flyball::test;

namespace {

std::atomic<long> allocations{0};

}  // namespace

void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}

void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

TEST_CASE("Steps and restarts do not allocate after the first") {
  for (const std::string& method : stepper_methods()) {
    INFO(method);
    auto system = harmonic();
    const auto stepper = make_stepper(method, system, {.max_step = 1.0, .fixed_step = 0.01});
    StepMemory memory;
    double x[] = {1.0, 0.0};
    stepper->restart(0.0, x, memory, true);
    double t = stepper->step(100.0, memory);
    const long before = allocations;
    for (int i = 0; i < 100; ++i) {
      t = stepper->step(100.0, memory);
      stepper->interpolate(t, x);
      if (i % 10 == 0) stepper->restart(t, x, memory, true);
    }
    const long made = allocations - before;
    CHECK(made == 0);
  }
}
