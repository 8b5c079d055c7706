// What every block owes to runs in lockstep: in each lane the bits of a run on numbers, with every
// instruction set.
#include "blocks/lanes.h"

#include "tests/catch.h"
#include "tests/contracts/cases.h"

namespace flyball::test {
namespace {

template <Isa isa>
class Group {
 public:
  explicit Group(const BlockObject& object) : together_(object), alone_(lane_count, Bench<double>(object)) {}

  const Specification& spec() const { return together_.spec(); }

  void draw(const Domain& domain, Random& random) {
    for (int k = 0; k < lane_count; ++k) {
      draw_all(alone_[k], domain, random);
      for (int s = 0; s < together_.size(); ++s) {
        together_.values[s].set_lane(k, alone_[k].values[s]);
        together_.bits[s] = static_cast<unsigned char>((together_.bits[s] & ~(1 << k)) |
                                                       (alone_[k].bits[s] != 0 ? 1 << k : 0));
      }
    }
  }

  /// The first lane in which a result differs; -1 when there is none.
  int first_difference(const Result& result) {
    together_.run(result.phase, 0, 1, result.crossing);
    for (int k = 0; k < lane_count; ++k) {
      alone_[k].run(result.phase, 0, 1, result.crossing);
      if (!same(result.in(together_)[result.slot].lane(k), result.in(alone_[k])[result.slot])) return k;
    }
    return -1;
  }

 private:
  Bench<Lanes<isa>> together_;
  std::vector<Bench<double>> alone_;
};

template <Isa isa>
void check(const Case& c) {
  const BlockObject object = c.object();
  const KernelTable& kernels = object.type->kernels;
  const bool alone = kernels.on_double.outputs != nullptr && kernels.on<Lanes<isa>>().outputs == nullptr;
  if (alone) return;
  Group<isa> group(object);
  Random random(17);
  for (const Result& result : results(group.spec(), true)) {
    for (int point = 0; point < 20; ++point) {
      group.draw(c.domain, random);
      INFO(c.type << " (" << c.label << "): " << result.name(group.spec()) << ", lane of difference");
      REQUIRE(group.first_difference(result) == -1);
    }
  }
}

}  // namespace

TEST_CASE("every lane has the bits of a run on numbers") {
  for (const Case& c : cases()) check<Isa::baseline>(c);
}

TEST_CASE("every lane of wider vectors has the bits of a run on numbers") {
  if (!supports(Isa::avx2)) return;
  for (const Case& c : cases()) check<Isa::avx2>(c);
}

}  // namespace flyball::test
