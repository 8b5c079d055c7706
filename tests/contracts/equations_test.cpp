// What every block owes the engine: all results written, the same bits for the same inputs wherever the
// instance stands, and derivatives that are those of its values.
#include <bit>
#include <cmath>

#include "blocks/jet.h"
#include "tests/catch.h"
#include "tests/contracts/cases.h"

namespace flyball::test {
namespace {

/// The numbers and bits of one instance, moved to another place.
void copy_instance(const Bench<double>& from, int i, Bench<double>& to, int k) {
  const int n = from.size();
  std::copy_n(from.values.begin() + i * n, n, to.values.begin() + k * n);
  std::copy_n(from.bits.begin() + i * n, n, to.bits.begin() + k * n);
}

void poison(Bench<double>& bench, const Result& result, Random& random) {
  // Any 64 bits are a double; two draws never agree.
  const double impossible = std::bit_cast<double>(random.word());
  result.in(bench)[result.slot] = impossible;
}

}  // namespace

TEST_CASE("every output, rate, relation, crossing and alarm is written on every path") {
  for (const Case& c : cases()) {
    Bench<double> bench(c.object());
    Random random(7);
    for (const Result& result : results(bench.spec(), false)) {
      for (int point = 0; point < 100; ++point) {
        draw_all(bench, c.domain, random);
        poison(bench, result, random);
        bench.run(result.phase);
        const double first = result.in(bench)[result.slot];
        poison(bench, result, random);
        bench.run(result.phase);
        INFO(c.type << " (" << c.label << "): " << result.name(bench.spec()) << " on double");
        REQUIRE(same(first, result.in(bench)[result.slot]));
      }
    }
  }
}

TEST_CASE("the same inputs give the same bits, alone and anywhere in a batch") {
  for (const Case& c : cases()) {
    const BlockObject object = c.object();
    Bench<double> batch(object, 3), single(object);
    Random random(11);
    for (const Result& result : results(batch.spec(), true)) {
      for (int point = 0; point < 20; ++point) {
        draw_all(batch, c.domain, random);
        const Bench<double> before = batch;
        batch.run(result.phase, 0, 3, result.crossing);
        for (int i = 0; i < 3; ++i) {
          copy_instance(before, i, single, 0);
          single.run(result.phase, 0, 1, result.crossing);
          INFO(c.type << " (" << c.label << "): " << result.name(batch.spec()) << ", instance " << i
                      << " of 3");
          REQUIRE(same(result.in(batch)[i * batch.size() + result.slot], result.in(single)[result.slot]));
        }
      }
    }
  }
}

namespace {

/// The result at x ± h in slot s.
double value_at(Bench<double>& bench, const Result& result, int s, double x) {
  const double kept = bench.values[s];
  bench.values[s] = x;
  bench.run(result.phase, 0, 1, result.crossing);
  const double y = result.in(bench)[result.slot];
  bench.values[s] = kept;
  return y;
}

Jet on_jet(const Bench<double>& at, const Result& result, int s) {
  Bench<Jet> bench(at.object());
  for (int k = 0; k < at.size(); ++k) bench.values[k] = Jet(at.values[k]);
  bench.values[s].v[0] = 1.0;
  bench.bits = at.bits;
  bench.run(result.phase, 0, 1, result.crossing);
  return result.in(bench)[result.slot];
}

void check_derivative(const Case& c, Bench<double>& bench, const Result& result, int s) {
  const double x = bench.values[s];
  // Truncation h^2/6 and rounding eps/h balance at h = eps^(1/3).
  const double h = std::cbrt(0x1p-52) * std::max(1.0, std::fabs(x));
  const double value = value_at(bench, result, s, x);
  const double difference =
      (value_at(bench, result, s, x + h) - value_at(bench, result, s, x - h)) / (2.0 * h);
  const Jet jet = on_jet(bench, result, s);
  INFO(c.type << " (" << c.label << "): " << result.name(bench.spec()) << " by " << bench.spec().slots[s].name
              << " at " << x);
  if (value == never) {
    REQUIRE((jet.a == never && jet.v[0] == 0.0));
    return;
  }
  // The Jet takes the same branches, but may round otherwise: products and quotients of Jets differ in form.
  REQUIRE(std::fabs(jet.a - value) <= 1e-13 * (1.0 + std::fabs(value)));
  // With third derivatives up to 1e3 of the scale: 1e3 * h^2/6 = 6e-9; rounding eps/h = 4e-11 of the value.
  const double scale = 1.0 + std::fabs(value) + std::fabs(difference);
  REQUIRE(std::fabs(jet.v[0] - difference) <= 1e-8 * scale);
}

}  // namespace

TEST_CASE("the derivatives on Jet are those of the values") {
  for (const Case& c : cases()) {
    Bench<double> bench(c.object());
    if (!bench.object().type->differentiable) continue;
    Random random(13);
    for (const Result& result : results(bench.spec(), true)) {
      for (int s = 0; s < bench.size(); ++s) {
        const SlotSpec& slot = bench.spec().slots[s];
        if (!slot.numeric() || slot.kind == SlotKind::relation || result.writes(slot.kind)) continue;
        for (int point = 0; point < 10; ++point) {
          draw_all(bench, c.domain, random);
          // Blocks branch on held values that are 0, so that a difference across 0 is no derivative.
          if (bench.values[s] == 0.0) bench.values[s] = 0.75;
          check_derivative(c, bench, result, s);
        }
      }
    }
  }
}

}  // namespace flyball::test
