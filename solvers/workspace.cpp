#include "solvers/workspace.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "blocks/random.h"
#include "solvers/errors.h"

namespace flyball {

template <class T>
Workspace<T>::Workspace(const Plan& plan)
    : values(plan.layout.size, T(0.0)),
      next(plan.layout.staged(), T(0.0)),
      bits(plan.layout.relations(), 0),
      sides(plan.layout.crossings(), 0),
      ticks(plan.hit_rates.size(), 0),
      next_objects(plan.layout.objects) {
  for (const auto& make : plan.first_objects) objects.push_back(make());
  for (auto make : plan.first_memories) memories.push_back(make());
  for (const Start& literal : plan.literals) values[literal.slot] = T(literal.value);
  seed(plan, *this, plan.diagram->simulation.seed);
}

template <class T>
void seed(const Plan& plan, Workspace<T>& workspace, std::uint64_t number) {
  for (const int slot : plan.streams) {
    workspace.values[slot] = T(random_stream(number, plan.instance(plan.owner[slot]).name));
  }
}

template <class T>
void derive(const Plan& plan, Workspace<T>& workspace) {
  for (const Derivation& d : plan.derivations) {
    workspace.values[d.slot] =
        d.formula->evaluate<T>([&](int k) { return workspace.values[d.operands[k]]; },
                               [](int, const T& a, const T& b) { return value_of(a) > value_of(b); });
  }
}

void lift(const Workspace<double>& from, Workspace<Jet>& to) {
  std::ranges::transform(from.values, to.values.begin(), [](double x) { return Jet(x); });
  to.bits = from.bits;
}

namespace {

template <class T>
void require_finite(const Plan& plan, const Workspace<T>& workspace, int slot, const char* what) {
  const double value = value_of(workspace.values[slot]);
  if (std::isfinite(value)) return;
  throw SimulationError(SimulationError::Kind::not_finite, 0.0,
                        fmt::format("{} {} is {}", what, plan.slot_name(slot), shown(value)));
}

}  // namespace

template <class T>
void initialise(const Plan& plan, Workspace<T>& workspace) {
  workspace.values[0] = T(0.0);
  derive(plan, workspace);
  for (const Derivation& d : plan.derivations) require_finite(plan, workspace, d.slot, "parameter");
  for (const Loop& loop : plan.loops) {
    for (const Loop::Tear& tear : loop.tears) workspace.values[tear.slot] = T(0.0);  // the first guess
  }
  for (const Start& start : plan.initial) {
    workspace.values[start.slot] = start.from < 0 ? T(start.value) : workspace.values[start.from];
    require_finite(plan, workspace, start.slot, "the initial value of");
  }
  std::fill(workspace.bits.begin(), workspace.bits.end(), 0);
  for (std::size_t k = 0; k < plan.crossing_records.size(); ++k) {
    // Armed, so that a crossing which begins beyond its threshold fires at the start.
    const Direction direction = plan.crossing_records[k].direction;
    workspace.sides[k] = direction == Direction::rising ? -1 : direction == Direction::falling ? 1 : 0;
  }
  for (std::size_t r = 0; r < plan.hit_rates.size(); ++r) workspace.ticks[r] = plan.hit_rates[r].offset_ticks;
  workspace.rates_map = workspace.zeros_map = workspace.logs_map = {};
  workspace.step = {};
  workspace.loops = {};
  workspace.log_position = 0;
}

template struct Workspace<double>;
template struct Workspace<Jet>;
template void seed(const Plan&, Workspace<double>&, std::uint64_t);
template void seed(const Plan&, Workspace<Jet>&, std::uint64_t);
template void derive(const Plan&, Workspace<double>&);
template void derive(const Plan&, Workspace<Jet>&);
template void initialise(const Plan&, Workspace<double>&);
template void initialise(const Plan&, Workspace<Jet>&);

}  // namespace flyball
