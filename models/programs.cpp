#include <algorithm>
#include <limits>
#include <map>

#include "models/calls.h"
#include "models/layout.h"

namespace flyball {
namespace {

/// One instance asked for one phase; calls are sorted by level, phase and place and then joined to batches.
/// In a cycle the knots come one after the other; a knot with tears is one call.
struct Call {
  int level = 0;
  int knot = 0;
  Phase phase = Phase::outputs;
  int place = 0;
  int cycle = -1;  // of a knot with tears; then there is no place

  auto operator<=>(const Call&) const = default;
};

constexpr int last_level = std::numeric_limits<int>::max();

class ProgramWriter {
 public:
  ProgramWriter(Plan& plan, const Order& order)
      : plan_(plan),
        order_(order),
        place_of_(plan.placed.size()),
        knot_(order.nodes(), 0),
        moves_(order.nodes(), false) {
    for (int k = 0; k < static_cast<int>(plan.placed.size()); ++k) place_of_[plan.placed[k]] = k;
    for (const Cycle& cycle : order.cycles()) {
      for (std::size_t k = 0; k < cycle.in_steps.size(); ++k) {
        for (const int node : cycle.in_steps[k].members) knot_[node] = static_cast<int>(k);
      }
    }
  }

  void run() {
    for (const Cycle& cycle : order_.cycles()) plan_.chains.push_back({cycle.begins, cycle.chain});
    write_sweep();
    find_moving();
    const std::vector<bool> rates_cone = cone_of_rates(), zeros_cone = cone_of_zeros();
    const std::vector<bool> logs_cone = cone_of_logs();
    plan_.rates_only = assemble(calls_with(SlotKind::state, Phase::rates));
    plan_.rates = assemble(cone_calls(rates_cone), calls_with(SlotKind::state, Phase::rates));
    std::vector<Call> zeros = located_calls();
    plan_.zeros = assemble(cone_calls(zeros_cone), zeros);
    std::vector<bool> rest = zeros_cone;
    for (std::size_t k = 0; k < rest.size(); ++k) rest[k] = rest[k] && !rates_cone[k];
    plan_.zeros_rest = assemble(cone_calls(rest), zeros);
    plan_.crossings = assemble(calls_with(SlotKind::crossing, Phase::crossings));
    plan_.schedules = assemble(calls_with(SlotKind::alarm, Phase::schedule));
    plan_.logs = assemble(cone_calls(logs_cone));
    plan_.steps = assemble(cone_calls(cone_of_steps()), step_calls());
    std::vector<bool> external(plan_.layout.size, false);
    mark_externals(plan_.rates, written_in(rates_cone), external);
    plan_.externals = slots_of(external);
    find_switches();
    find_frozen(std::move(external), written_in(zeros_cone), written_in(logs_cone));
  }

 private:
  const BlockObject& object(int instance) const { return *plan_.instance(instance).object; }
  const SlotSpec& slot(Endpoint e) const { return object(e.instance).specification->slots[e.slot]; }
  int instances() const { return static_cast<int>(plan_.placed.size()); }

  Program assemble(std::vector<Call> calls, const std::vector<Call>& more = {}) {
    std::ranges::sort(calls);
    calls.erase(std::unique(calls.begin(), calls.end()), calls.end());
    calls.insert(calls.end(), more.begin(), more.end());
    Program program;
    for (const Call& call : calls) {
      if (call.cycle < 0) {
        append_call(plan_, program, call.phase, call.place);
      } else {
        append_loop(program, order_.cycles()[call.cycle], order_.cycles()[call.cycle].in_steps[call.knot]);
      }
    }
    return program;
  }

  /// All programs share the numbers of a loop, so what one of them learns of it serves the others.
  void append_loop(Program& program, const Cycle& cycle, const Knot& knot) {
    LoopCalls calls = write_loop(plan_, order_, knot, place_of_);
    calls.loop.chain = chain_of(cycle);
    const auto [known, is_new] = loops_.emplace(&knot, static_cast<int>(plan_.loops.size()));
    if (is_new) plan_.loops.push_back(std::move(calls.loop));
    const auto first = static_cast<int>(program.ops.size());
    program.ops.insert(program.ops.end(), calls.ops.begin(), calls.ops.end());
    program.loops.push_back({first, static_cast<int>(program.ops.size()), known->second});
  }

  int chain_of(const Cycle& cycle) const { return static_cast<int>(&cycle - order_.cycles().data()); }

  /// Everything, level by level; the bits of a relation settle in its own level.
  void write_sweep() {
    std::vector<Call> calls;
    std::vector<std::vector<const Cycle*>> cycles(order_.levels());
    for (const Cycle& cycle : order_.cycles()) cycles[cycle.level].push_back(&cycle);
    for (int node = 0; node < order_.nodes(); ++node) {
      if (order_.level(node) < 0 || order_.cycle(node) >= 0) continue;
      const Endpoint e = order_.endpoint(node);
      const bool bit = slot(e).kind == SlotKind::relation;
      calls.push_back(
          {order_.level(node), 0, bit ? Phase::relations : Phase::outputs, place_of_[e.instance]});
    }
    std::ranges::sort(calls);
    calls.erase(std::unique(calls.begin(), calls.end()), calls.end());
    std::size_t done = 0;
    for (int level = 0; level < order_.levels(); ++level) {
      // A batch must not reach over levels: what it settles would come too late or too early.
      Program part;
      for (; done < calls.size() && calls[done].level == level; ++done) {
        append_call(plan_, part, calls[done].phase, calls[done].place);
      }
      for (Op op : part.ops) {
        if (op.phase == Phase::relations) settle(op, level);
        plan_.sweep.ops.push_back(op);
      }
      for (const Cycle* cycle : cycles[level]) write_cycle(*cycle);
    }
  }

  /// The outputs for given bits, then the relations that set these bits.
  void write_cycle(const Cycle& cycle) {
    Program& sweep = plan_.sweep;
    ModeSpan span;
    span.first = static_cast<int>(sweep.ops.size());
    for (const Knot& knot : cycle.at_hits) {
      if (!knot.tears.empty()) {
        append_loop(sweep, cycle, knot);
      } else {
        const Endpoint e = order_.endpoint(knot.members.front());
        append_call(plan_, sweep, Phase::outputs, place_of_[e.instance], false);
      }
    }
    if (cycle.relations.empty()) return;
    span.settle_first = static_cast<int>(sweep.settle.size());
    std::vector<Call> calls;
    for (const int node : cycle.relations) {
      const Endpoint e = order_.endpoint(node);
      calls.push_back({cycle.level, 0, Phase::relations, place_of_[e.instance]});
      sweep.settle.push_back(plan_.index_of(e.instance)[e.slot]);
    }
    std::ranges::sort(calls);
    calls.erase(std::unique(calls.begin(), calls.end()), calls.end());
    for (const Call& call : calls) append_call(plan_, sweep, call.phase, call.place, false);
    span.last = static_cast<int>(sweep.ops.size());
    span.settle_count = static_cast<int>(cycle.relations.size());
    span.chain = chain_of(cycle);
    sweep.modes.push_back(std::move(span));
  }

  void settle(Op& op, int level) {
    op.settle_first = static_cast<int>(plan_.sweep.settle.size());
    for (int k = 0; k < op.count; ++k) {
      const int instance = plan_.placed[op.place + k];
      for (int s = 0; s < op.stride; ++s) {
        const int node = order_.node(instance, s);
        const bool here = order_.level(node) == level && order_.cycle(node) < 0;
        if (here && slot({instance, s}).kind == SlotKind::relation) {
          plan_.sweep.settle.push_back(plan_.index_of(instance)[s]);
        }
      }
    }
    op.settle_count = static_cast<int>(plan_.sweep.settle.size()) - op.settle_first;
  }

  std::vector<Call> calls_with(SlotKind kind, Phase phase) const {
    std::vector<Call> calls;
    for (int place = 0; place < instances(); ++place) {
      if (object(plan_.placed[place]).specification->has(kind))
        calls.push_back({last_level, 0, phase, place});
    }
    return calls;
  }

  std::vector<Call> cone_calls(const std::vector<bool>& cone) const {
    std::vector<Call> calls;
    for (int node = 0; node < order_.nodes(); ++node) {
      if (!cone[node]) continue;
      const int cycle = order_.cycle(node), level = order_.level(node);
      const bool torn = cycle >= 0 && !order_.cycles()[cycle].in_steps[knot_[node]].tears.empty();
      const int place = torn ? -1 : place_of_[order_.endpoint(node).instance];
      calls.push_back({level, knot_[node], Phase::outputs, place, torn ? cycle : -1});
    }
    return calls;
  }

  /// Finds the outputs that move during a step: unsampled, and behind them time or a state. What does not
  /// move keeps the value of the last sweep, so minor steps need not compute it.
  void find_moving() {
    std::vector<std::vector<int>> plain(order_.levels());
    std::vector<std::vector<const Cycle*>> cycles(order_.levels());
    for (const Cycle& cycle : order_.cycles()) cycles[cycle.level].push_back(&cycle);
    for (int node = 0; node < order_.nodes(); ++node) {
      const bool in_cycle = order_.cycle(node) >= 0;
      const Endpoint e = order_.level(node) < 0 || in_cycle ? Endpoint{} : order_.endpoint(node);
      const bool output = e.connected() && slot(e).kind == SlotKind::output;
      if (output && plan_.rate_of[e.instance] < 0) plain[order_.level(node)].push_back(node);
    }
    for (int level = 0; level < order_.levels(); ++level) {
      for (const int node : plain[level]) moves_[node] = reads_moving(node);
      for (const Cycle* cycle : cycles[level]) {
        for (const Knot& knot : cycle->in_steps) {
          const bool moving = std::ranges::any_of(knot.members, [&](int node) { return reads_moving(node); });
          for (const int node : knot.members) moves_[node] = moving;
        }
      }
    }
  }

  bool reads_moving(int node) const {
    const Endpoint e = order_.endpoint(node);
    return std::ranges::any_of(object(e.instance).reads[e.slot], [&](int read) {
      return moves({e.instance, read});
    });
  }

  bool moves(Endpoint read) const {
    const Endpoint source = order_.source(read.instance, read.slot);
    const Endpoint e = source.connected() ? source : read;
    const SlotKind kind = slot(e).kind;
    return kind == SlotKind::time || kind == SlotKind::state || moves_[order_.node(e)];
  }

  /// Marks the moving outputs behind slots `reads` of an instance, and what is behind them. Bits are frozen
  /// between instants, so they do not lead further.
  void mark(std::vector<bool>& cone, int instance, const std::vector<int>& reads) const {
    std::vector<Endpoint> open;
    const auto visit = [&](Endpoint e) {
      if (!moves_[order_.node(e)] || cone[order_.node(e)]) return;
      cone[order_.node(e)] = true;
      open.push_back(e);
    };
    order_.behind(instance, reads, visit);
    while (!open.empty()) {
      const Endpoint e = open.back();
      open.pop_back();
      order_.behind(e.instance, object(e.instance).reads[e.slot], visit);
    }
  }

  std::vector<bool> cone_of_rates() const {
    std::vector<bool> cone(order_.nodes(), false);
    for (int i = 0; i < instances(); ++i) {
      for (const auto& reads : object(i).rate_reads) mark(cone, i, reads);
    }
    return cone;
  }

  bool located(int instance) const {
    return plan_.rate_of[instance] < 0 && (object(instance).specification->has(SlotKind::relation) ||
                                           object(instance).specification->has(SlotKind::crossing));
  }

  std::vector<bool> cone_of_zeros() const {
    std::vector<bool> cone(order_.nodes(), false);
    for (int i = 0; i < instances(); ++i) {
      if (!located(i)) continue;
      for (int s = 0; s < static_cast<int>(object(i).reads.size()); ++s) {
        const SlotKind kind = slot({i, s}).kind;
        if (kind == SlotKind::relation || kind == SlotKind::crossing) mark(cone, i, object(i).reads[s]);
      }
    }
    return cone;
  }

  std::vector<Call> located_calls() {
    std::vector<Call> calls;
    for (const Phase phase : {Phase::relations, Phase::crossings}) {
      const SlotKind kind = phase == Phase::relations ? SlotKind::relation : SlotKind::crossing;
      for (const Call& call : calls_with(kind, phase)) {
        if (located(plan_.placed[call.place])) calls.push_back(call);
      }
    }
    for (int slot = plan_.layout.first_relation; slot < plan_.layout.first_crossing; ++slot) {
      if (located(plan_.owner[slot])) plan_.located_relations.push_back(slot);
    }
    return calls;
  }

  std::vector<bool> cone_of_logs() const {
    std::vector<bool> cone(order_.nodes(), false);
    for (const Logged& logged : plan_.diagram->logged) {
      // Asked as if an input read it, so that pass-throughs are followed.
      mark(cone, logged.source.instance, {logged.source.slot});
    }
    return cone;
  }

  bool remembers(int instance) const { return object(instance).type->kernels.on_double.on_step != nullptr; }

  std::vector<bool> cone_of_steps() const {
    std::vector<bool> cone(order_.nodes(), false);
    for (int i = 0; i < instances(); ++i) {
      if (!remembers(i)) continue;
      std::vector<int> inputs;
      for (int s = 0; s < static_cast<int>(object(i).specification->slots.size()); ++s) {
        if (slot({i, s}).kind == SlotKind::input) inputs.push_back(s);
      }
      mark(cone, i, inputs);
    }
    return cone;
  }

  std::vector<Call> step_calls() const {
    std::vector<Call> calls;
    for (int place = 0; place < instances(); ++place) {
      if (remembers(plan_.placed[place])) calls.push_back({last_level, 0, Phase::step, place});
    }
    return calls;
  }

  std::vector<bool> written_in(const std::vector<bool>& cone) const {
    std::vector<bool> written(plan_.layout.size, false);
    for (int node = 0; node < order_.nodes(); ++node) {
      const Endpoint e = order_.endpoint(node);
      if (cone[node]) written[plan_.index_of(e.instance)[e.slot]] = true;
    }
    return written;
  }

  /// Marks what a program reads and does not write, but for states, parameters and time.
  void mark_externals(const Program& program, const std::vector<bool>& written,
                      std::vector<bool>& marked) const {
    const Layout& layout = plan_.layout;
    for (const Op& op : program.ops) {
      const auto& reads = op.phase == Phase::rates ? op.object->rate_reads : op.object->reads;
      for (int k = 0; k < op.count; ++k) {
        const int* index = plan_.index.data() + op.first + k * op.stride;
        for (const auto& slots : reads) {
          for (const int s : slots) {
            const int at = op.object->specification->slots[s].numeric() ? index[s] : -1;
            if (at >= layout.first_held && at < layout.first_crossing && !written[at]) marked[at] = true;
          }
        }
      }
    }
  }

  std::vector<int> slots_of(const std::vector<bool>& marked) const {
    std::vector<int> slots;
    for (int s = 0; s < plan_.layout.size; ++s) {
      if (marked[s]) slots.push_back(s);
    }
    return slots;
  }

  void find_frozen(std::vector<bool> marked, const std::vector<bool>& written_by_zeros,
                   const std::vector<bool>& written_by_logs) {
    mark_externals(plan_.zeros, written_by_zeros, marked);
    mark_externals(plan_.logs, written_by_logs, marked);
    for (const LogColumn& column : plan_.columns) {
      if (column.slot >= plan_.layout.first_held && !written_by_logs[column.slot]) marked[column.slot] = true;
    }
    for (const int slot : plan_.switches) marked[slot] = true;
    plan_.frozen = slots_of(marked);
  }

  void find_switches() {
    std::vector<bool> found(plan_.layout.size, false);
    for (const Program* program : {&plan_.rates, &plan_.zeros, &plan_.logs}) {
      for (const Op& op : program->ops) {
        const auto& slots = op.object->specification->slots;
        for (int k = 0; k < op.count * op.stride; ++k) {
          const SlotKind kind = slots[k % op.stride].kind;
          if (kind == SlotKind::relation || kind == SlotKind::held) found[plan_.index[op.first + k]] = true;
        }
      }
    }
    plan_.switches = slots_of(found);
  }

  Plan& plan_;
  const Order& order_;
  std::vector<int> place_of_;
  std::map<const Knot*, int> loops_;  // Plan::loops
  std::vector<int> knot_;             // of each node in a cycle: its place in Cycle::in_steps
  std::vector<bool> moves_;           // of each node
};

}  // namespace

void write_programs(Plan& plan, const Order& order) { ProgramWriter(plan, order).run(); }

}  // namespace flyball
