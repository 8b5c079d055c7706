// A program that runs models for weeks must not grow. With FLYBALL_SOAK=1 in the environment the counts are
// in full.
#include <malloc.h>

#include <cstdlib>
#include <fstream>

#include "tests/systems/harness.h"

using namespace flyball;
using namespace flyball::test;

namespace {

/// What the program holds: the bytes it has asked for and not given back, which a leak of one byte a run
/// would show, and the memory that the machine spends on it, which also shows what falls to pieces.
struct Memory {
  double allocated = 0.0;
  double resident = 0.0;

  static Memory now() {
    const struct mallinfo2 heap = mallinfo2();
    long pages = 0;
    std::ifstream("/proc/self/statm") >> pages >> pages;
    return {static_cast<double>(heap.uordblks + heap.hblkhd), static_cast<double>(pages) * 4096.0};
  }
};

bool in_full() { return std::getenv("FLYBALL_SOAK") != nullptr; }

/// Calls `work` until memory has settled, then `times` times, or a tenth of it.
template <class Work>
void check_growth(int times, const Work& work) {
  if (!in_full()) times /= 10;
  for (int k = 0; k < 1000; ++k) work();
  const Memory before = Memory::now();
  for (int k = 0; k < times; ++k) work();
  const Memory after = Memory::now();
  CHECK(after.allocated - before.allocated < 1e6);
  CHECK(after.resident - before.resident < 1e6);
}

/// A ball that bounces once, and a sampled counter.
std::string model(const std::string& method) {
  return R"toml(flyball = 1
[blocks]
ball = { type = "BouncingBall", initial_height = "1 cm" }
count = { type = "CounterLimited", sample_time = "20 ms" }
[diagram]
log = ["ball.height", "count"]
[simulation]
stop = "50 ms"
log_interval = "25 ms"
solver = { max_step = "25 ms", step = "10 ms", method = ")toml" +
         method + "\" }\n";
}

}  // namespace

TEST_CASE("a million runs in one process do not make it grow") {
  const Model ball = read_model(model("dp5"));
  check_growth(1'000'000, [&] { Simulator(ball.plan, ball.settings).run(); });
}

TEST_CASE("many runs of each method, and many models, do not make a process grow") {
  for (const std::string method : {"auto", "euler", "heun", "rk4", "bdf", "adams"}) {
    INFO(method);
    const Model ball = read_model(model(method));
    check_growth(10'000, [&] { Simulator(ball.plan, ball.settings).run(); });
  }
  check_growth(10'000, [&] { read_model(model("dp5")); });
  check_growth(10'000,
               [&] { CHECK_FALSE(refusal_of("flyball = 1\n[blocks]\nk = { type = \"Gian\" }\n").empty()); });
}
