// Blocks with object memory: the same on double and, through the shim, on Jet; copied deeply with their
// workspace.
#include "blocks/jet_kernels.h"
#include "tests/blocks/bench.h"
#include "tests/catch.h"
#include "tests/contracts/memory_block.h"

namespace flyball::test {
namespace {

const BlockType& recorder() {
  static const BlockType type = describe<Recorder>("Recorder", "test");
  return type;
}

enum Slot { time, ts, gain, u, y, hits, remembered, before, all };

template <class T>
Bench<T> bench_with_history() {
  Bench<T> bench(recorder().create());
  bench.values[gain] = T(2.0);
  bench.objects[before] = std::make_shared<const Samples>(Samples{{4.0}});
  return bench;
}

template <class T>
void hit(Bench<T>& bench, double input) {
  bench.values[u] = T(input);
  bench.run(Phase::outputs);
  bench.run(Phase::sample);
  bench.values[hits] = bench.next[hits];
}

template <class T>
std::vector<double> published(const Bench<T>& bench) {
  return static_cast<const Samples*>(bench.objects[all].get())->values;
}

template <class T>
const std::vector<double>& memory(const Bench<T>& bench) {
  return std::any_cast<const Samples&>(bench.memories[remembered]).values;
}

}  // namespace

TEMPLATE_TEST_CASE("a block with memory runs on double and through the shim on Jet", "", double, Jet) {
  auto bench = bench_with_history<TestType>();
  REQUIRE(bench.object().specification->slots[all].name == "all");
  hit(bench, 1.0);
  // gain * (4 + 1)/2; sums of small integers are exact
  CHECK(value_of(bench.values[y]) == 5.0);
  hit(bench, 4.0);
  CHECK(value_of(bench.values[y]) == 6.0);
  CHECK(value_of(bench.values[hits]) == 2.0);
  CHECK(published(bench) == std::vector<double>{4.0, 1.0, 4.0});
  CHECK(memory(bench) == std::vector<double>{1.0, 4.0});
}

TEST_CASE("a block on double alone contributes no derivative") {
  auto bench = bench_with_history<Jet>();
  bench.values[gain].v[0] = 1.0;
  bench.values[u].v[1] = 1.0;
  bench.values[y].v[2] = 1.0;
  bench.run(Phase::outputs);
  CHECK(bench.values[y].v.isZero(0.0));
  CHECK(bench.values[gain].v[0] == 1.0);
}

TEST_CASE("a copied run has memories of its own") {
  auto run = bench_with_history<double>();
  hit(run, 1.0);
  auto checkpoint = run;
  hit(run, 2.0);
  CHECK(memory(checkpoint) == std::vector<double>{1.0});
  hit(checkpoint, 7.0);
  CHECK(memory(run) == std::vector<double>{1.0, 2.0});
  CHECK(published(checkpoint) == std::vector<double>{4.0, 1.0, 7.0});
}

TEMPLATE_TEST_CASE("instances in a batch have memories and objects of their own", "", double, Jet) {
  Bench<TestType> bench(recorder().create(), 3);
  for (int i = 0; i < 3; ++i) {
    bench.values[i * bench.size() + gain] = TestType(1.0);
    bench.values[i * bench.size() + u] = TestType(10.0 * i);
  }
  bench.run(Phase::outputs);
  for (int i = 0; i < 3; ++i) {
    CHECK(value_of(bench.values[i * bench.size() + y]) == 10.0 * i);
    const auto& own = std::any_cast<const Samples&>(bench.memories[i * bench.size() + remembered]);
    CHECK(own.values == std::vector<double>{10.0 * i});
  }
}

TEST_CASE("an object port shows a default value before the first hit") {
  const Bench<double> bench(recorder().create());
  REQUIRE(bench.objects[all] != nullptr);
  CHECK(published(bench).empty());
}

TEST_CASE("each output of a block on double alone is taken to read every input") {
  const BlockObject object = recorder().create();
  CHECK(object.reads[y] == std::vector<int>{ts, gain, u, hits, before});
  CHECK(object.reads[all] == object.reads[y]);
}

}  // namespace flyball::test
