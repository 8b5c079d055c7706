#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "blocks/registry.h"
#include "tests/blocks/bench.h"

namespace flyball::test {

/// What signals are drawn from, as the function's domain allows: (-span, span), or (0, span). Slots named in
/// `within` are drawn from there, to keep others away from a singular point.
struct Domain {
  double span = 2.0;
  bool positive = false;
  std::map<std::string, Range> within = {};
};

/// A structure of a block type that the contracts are checked on.
struct Case {
  std::string type;
  std::string label;
  Keys keys;
  Domain domain = {};

  BlockObject object() const { return create(type, keys); }
};

/// The default structure of every block in the catalogue, and further structures.
std::vector<Case> cases();

/// Numbers that are the same on every platform, so that a failure can be repeated.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t word();
  double uniform(double lower, double upper);

 private:
  std::uint64_t state_;
};

/// A value for a slot: parameters inside their range, held values 0 a third of the time, since 0 is what they
/// branch on.
double draw(const SlotSpec& slot, const Domain& domain, Random& random);

/// Draws every number of every instance, and the bits of its relations.
void draw_all(Bench<double>& bench, const Domain& domain, Random& random);

/// A result of a phase: where its number is found after `run`.
struct Result {
  Phase phase;
  int crossing;  // of a crossing's handler
  int slot;
  template <class T>
  std::vector<T>& in(Bench<T>& bench) const {
    return is_handler(phase) ? bench.next : phase == Phase::rates ? bench.rates : bench.values;
  }
  /// Whether a slot of this kind is written in the same phase, so that it is no argument of the result.
  bool writes(SlotKind kind) const;
  std::string name(const Specification& spec) const;
};

/// All that the equations of a block compute; with `handlers`, also the next states and held values.
std::vector<Result> results(const Specification& spec, bool handlers);

/// Equal bits: -0 is not 0, and a NaN equals itself.
bool same(double a, double b);

}  // namespace flyball::test
