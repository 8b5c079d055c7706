// What reads what is derived from the form of the equations; here it is confirmed by their values.
#include <algorithm>

#include "tests/catch.h"
#include "tests/contracts/cases.h"

namespace flyball::test {
namespace {

const std::vector<int>& derived(const BlockObject& object, const Result& result) {
  return result.phase == Phase::rates ? object.rate_reads[result.slot] : object.reads[result.slot];
}

/// Whether another value of slot `s` (another bit, of a relation) changes the result at this point.
bool changes(Bench<double>& bench, const Result& result, int s, const Domain& domain, Random& random) {
  bench.run(result.phase);
  const double before = result.in(bench)[result.slot];
  const SlotSpec& slot = bench.spec().slots[s];
  const double value = bench.values[s];
  if (slot.kind == SlotKind::relation) {
    bench.bits[s] ^= 1;
  } else {
    bench.values[s] = slot.kind == SlotKind::held && value != 0.0 ? 0.0 : draw(slot, domain, random);
  }
  bench.run(result.phase);
  const double after = result.in(bench)[result.slot];
  if (slot.kind == SlotKind::relation) {
    bench.bits[s] ^= 1;
  } else {
    bench.values[s] = value;
  }
  return !same(before, after);
}

void check(const Case& c, const BlockObject& object, const Result& result) {
  Bench<double> bench(object);
  const std::string name = result.name(bench.spec());
  for (int s = 0; s < bench.size(); ++s) {
    const SlotSpec& slot = bench.spec().slots[s];
    if (!slot.numeric() || result.writes(slot.kind)) continue;
    Random random(1000 * s + result.slot);
    bool changed = false;
    // Enough points for each combination of four bits to be met: the chance to miss one is (15/16)^200 <
    // 3e-6.
    for (int point = 0; point < 200 && !changed; ++point) {
      draw_all(bench, c.domain, random);
      changed = changes(bench, result, s, c.domain, random);
    }
    const bool reads = std::ranges::binary_search(derived(object, result), s);
    INFO(c.type << " (" << c.label << "): " << name << " and " << slot.name);
    // What a memory or an object holds is not drawn, so what is read along with it may go unnoticed.
    const bool holds = bench.spec().has(SlotKind::memory) || bench.spec().has(SlotKind::object_input);
    const bool unnoticed = reads && holds;
    CHECK((changed == reads || unnoticed));
  }
}

}  // namespace

TEST_CASE("a result changes with the slots that it is derived to read, and with no other") {
  for (const Case& c : cases()) {
    const BlockObject object = c.object();
    if (!object.type->differentiable) continue;
    for (const Result& result : results(*object.specification, false)) check(c, object, result);
  }
}

}  // namespace flyball::test
