// Declarations and methods that do not agree are refused when a block type is first constructed.
#include "blocks/jet_kernels.h"
#include "tests/catch.h"

namespace flyball::test {
namespace {

struct Text {
  static constexpr auto summary = "A mistake.";
};

struct NoRates : Block, Text {
  using Block::Block;
  State x = state("x", 0.0, "any", "state");
};
struct MisspeltRates : NoRates {
  using NoRates::NoRates;
  void ratse(auto& v) const { v.rate(x) = 0.0; }
};
struct RatesThatAreNotConst : NoRates {
  using NoRates::NoRates;
  void rates(auto& v) { v.rate(x) = 0.0; }
};
struct RatesWithoutState : Block, Text {
  using Block::Block;
  void rates(auto&) const {}
};
struct NoOutputs : Block, Text {
  using Block::Block;
  Output y = output("y", "any", "output");
};
struct OutputsWithoutOutput : Block, Text {
  using Block::Block;
  void outputs(auto&) const {}
};
struct OutputsOfAnAliasAlone : Block, Text {
  using Block::Block;
  State x = state("x", 0.0, "any", "state");
  Output y = output("y", x, "the state");
  void rates(auto& v) const { v.rate(x) = 0.0; }
  void outputs(auto&) const {}
};
struct NoRelations : Block, Text {
  using Block::Block;
  Relation r = relation("r", "relation");
};
struct RelationsWithoutRelation : Block, Text {
  using Block::Block;
  void relations(auto&) const {}
};
struct NoCrossings : Block, Text {
  using Block::Block;
  Crossing c = crossing("c", Direction::rising, "crossing");
  void on_crossing(Crossing, auto&) const {}
};
struct NoOnCrossing : Block, Text {
  using Block::Block;
  Crossing c = crossing("c", Direction::rising, "crossing");
  void crossings(auto& v) const { v[c] = 0.0; }
};
struct OnCrossingWithoutCrossing : Block, Text {
  using Block::Block;
  void on_crossing(Crossing, auto&) const {}
};
struct NoSchedule : Block, Text {
  using Block::Block;
  Alarm a = alarm("a", "alarm");
  void on_time(auto&) const {}
};
struct NoOnTime : Block, Text {
  using Block::Block;
  Alarm a = alarm("a", "alarm");
  void schedule(auto& v) const { v[a] = never; }
};
struct TwoAlarms : NoOnTime {
  using NoOnTime::NoOnTime;
  Alarm second = alarm("b", "alarm");
  void on_time(auto&) const {}
};
struct OnSampleWithoutSampleTime : Block, Text {
  using Block::Block;
  void on_sample(auto&) const {}
};
struct OnStepWithoutMemory : Block, Text {
  using Block::Block;
  void on_step(auto&) const {}
};
struct LatchedAlias : Block, Text {
  using Block::Block;
  SampleTime ts = sample_time();
  Held h = held("h", 0.0, "any", "held");
  Output y = output("y", h, "the held value");
};
struct UnsampledOnDouble : Block, Text {
  using Block::Block;
  static constexpr bool differentiable = false;
  Output y = output("y", "any", "output");
  void outputs(auto& v) const { v[y] = 0.0; }
};
struct ForgetsAnOutput : Block, Text {
  using Block::Block;
  Output y = output("y", "any", "output"), z = output("z", "any", "output");
  void outputs(auto& v) const { v[y] = 0.0; }
};
struct ForgetsARate : NoRates {
  using NoRates::NoRates;
  State z = state("z", 0.0, "any", "state");
  void rates(auto& v) const { v.rate(x) = 0.0; }
};
struct RefusesItself : Block, Text {
  explicit RefusesItself(Settings* settings) : Block(settings) { refuse("key", "expected better"); }
};

template <class B>
std::string refusal() {
  try {
    describe<B>("Bad", "test").create();
  } catch (const std::logic_error& error) {
    return error.what();
  }
  return "nothing was refused";
}

}  // namespace

TEST_CASE("a declaration needs its method") {
  CHECK(refusal<NoRates>() == "block Bad: declares State but has no method rates(auto& v) const");
  CHECK(refusal<NoOutputs>() == "block Bad: declares Output but has no method outputs(auto& v) const");
  CHECK(refusal<NoRelations>() == "block Bad: declares Relation but has no method relations(auto& v) const");
  CHECK(refusal<NoCrossings>() == "block Bad: declares Crossing but has no method crossings(auto& v) const");
  CHECK(refusal<NoOnCrossing>() ==
        "block Bad: declares Crossing but has no method on_crossing(Crossing c, auto& v) const");
  CHECK(refusal<NoSchedule>() == "block Bad: declares Alarm but has no method schedule(auto& v) const");
  CHECK(refusal<NoOnTime>() == "block Bad: declares Alarm but has no method on_time(auto& v) const");
}

TEST_CASE("a method that is misspelt or not const is missing") {
  CHECK(refusal<MisspeltRates>() == refusal<NoRates>());
  CHECK(refusal<RatesThatAreNotConst>() == refusal<NoRates>());
}

TEST_CASE("a method needs its declaration") {
  CHECK(refusal<RatesWithoutState>() == "block Bad: has a method rates(auto& v) const but declares no State");
  CHECK(refusal<OutputsWithoutOutput>() ==
        "block Bad: has a method outputs but declares no Output of its own");
  CHECK(refusal<OutputsOfAnAliasAlone>() == refusal<OutputsWithoutOutput>());
  CHECK(refusal<RelationsWithoutRelation>() ==
        "block Bad: has a method relations(auto& v) const but declares no Relation");
  CHECK(refusal<OnCrossingWithoutCrossing>() ==
        "block Bad: has a method on_crossing(Crossing c, auto& v) const but declares no Crossing");
  CHECK(refusal<OnSampleWithoutSampleTime>() ==
        "block Bad: has a method on_sample but declares no SampleTime");
  CHECK(refusal<OnStepWithoutMemory>() == "block Bad: has a method on_step but declares no Memory");
}

TEST_CASE("a result that no equation writes is refused by name") {
  CHECK(refusal<ForgetsAnOutput>() == "block Bad: z is never written");
  CHECK(refusal<ForgetsARate>() == "block Bad: z is never written");
}

TEST_CASE("declarations that contradict the time semantics are refused") {
  CHECK(refusal<TwoAlarms>() == "block Bad: declares more than one Alarm");
  CHECK(refusal<LatchedAlias>() ==
        "block Bad: output y of a sampled block must be latched, so it cannot share a held value's slot");
  CHECK(refusal<UnsampledOnDouble>() ==
        "block Bad: a block on double alone must be sampled, without State and Relation");
}

TEST_CASE("a block that refuses its own defaults is a mistake") {
  CHECK(refusal<RefusesItself>() == "block Bad: refuses its own defaults");
}

}  // namespace flyball::test
