#include "solvers/lane_group.h"

#include <algorithm>

namespace flyball {
namespace {

LaneMask with_lane(LaneMask mask, int lane, bool on) {
  const auto bit = static_cast<LaneMask>(1u << lane);
  return static_cast<LaneMask>(on ? mask | bit : mask & ~bit);
}

}  // namespace

template <Isa isa>
LaneGroup<isa>::LaneGroup(const Plan& of)
    : plan(of),
      values(of.layout.size, T(0.0)),
      next(of.layout.staged(), T(0.0)),
      bits(of.layout.relations(), 0),
      up(of.layout.crossings(), 0),
      down(of.layout.crossings(), 0),
      sweep(bind(of.sweep)),
      rates(bind(of.rates)),
      zeros(bind(of.zeros)),
      zeros_rest(bind(of.zeros_rest)),
      logs(bind(of.logs)),
      crossings(bind(of.crossings)),
      schedules(bind(of.schedules)) {}

template <Isa isa>
typename LaneGroup<isa>::Calls LaneGroup<isa>::bind(const Program& program) const {
  Calls calls;
  for (const Op& op : program.ops) {
    const Kernels<T>& on_lanes = op.object->type->kernels.template on<T>();
    calls.push_back({on_lanes.sweep(op.phase), op.self, plan.index.data() + op.first, op.stride, op.count});
  }
  return calls;
}

template <Isa isa>
void LaneGroup<isa>::load(int lane, const Workspace<double>& from, bool counts) {
  for (std::size_t s = 0; s < values.size(); ++s) values[s].set_lane(lane, from.values[s]);
  for (std::size_t r = 0; r < bits.size(); ++r) bits[r] = with_lane(bits[r], lane, from.bits[r] != 0);
  for (std::size_t k = 0; k < up.size(); ++k) {
    up[k] = with_lane(up[k], lane, from.sides[k] > 0);
    down[k] = with_lane(down[k], lane, from.sides[k] < 0);
  }
  std::copy_n(states(), next.size(), next.begin());
  objects = from.objects;
  next_objects.resize(objects.size());
  active_ = with_lane(active_, lane, counts);
}

template <Isa isa>
void LaneGroup<isa>::store(int lane, Workspace<double>& to) const {
  for (std::size_t s = 0; s < values.size(); ++s) to.values[s] = values[s].lane(lane);
  for (std::size_t r = 0; r < bits.size(); ++r) to.bits[r] = (bits[r] >> lane) & 1u;
}

template <Isa isa>
Frame<Lanes<isa>> LaneGroup<isa>::frame(T* to_rates) {
  Frame<T> f;
  f.values = values.data();
  f.rates = to_rates;
  f.next = next.data();
  f.bits = bits.data();
  f.objects = objects.data();
  f.next_objects = next_objects.data();
  f.first_state = plan.layout.first_state;
  f.first_relation = plan.layout.first_relation;
  return f;
}

template <Isa isa>
void LaneGroup<isa>::run(const Calls& calls, T* to_rates) {
  const Frame<T> f = frame(to_rates);
  for (const Call& call : calls) run(call, f);
}

template <Isa isa>
void LaneGroup<isa>::drop_bad_outputs() {
  const Layout& layout = plan.layout;
  const LaneMask finite =
      Arithmetic::finite(values.data() + layout.first_state, layout.first_relation - layout.first_state);
  // A limit may be infinite, so a relation may; NaN has no sign.
  const LaneMask ordered =
      Arithmetic::ordered(values.data() + layout.first_relation, layout.first_alarm - layout.first_relation);
  active_ &= finite & ordered;
}

template class LaneGroup<Isa::baseline>;
template class LaneGroup<Isa::avx2>;

}  // namespace flyball
