#include <algorithm>
#include <limits>
#include <tuple>

#include "models/layout.h"

namespace flyball {
namespace {

/// One instance asked for one phase; calls are sorted by level, phase and place and then joined to batches.
struct Call {
  int level = 0;
  Phase phase = Phase::outputs;
  int place = 0;

  auto operator<=>(const Call&) const = default;
};

constexpr int last_level = std::numeric_limits<int>::max();

class ProgramWriter {
 public:
  ProgramWriter(Plan& plan, const Order& order)
      : plan_(plan), order_(order), place_of_(plan.placed.size()), moves_(order.nodes(), false) {
    for (int k = 0; k < static_cast<int>(plan.placed.size()); ++k) place_of_[plan.placed[k]] = k;
  }

  void run() {
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

  Program assemble(std::vector<Call> calls, const std::vector<Call>& more = {}) const {
    std::ranges::sort(calls);
    calls.erase(std::unique(calls.begin(), calls.end()), calls.end());
    calls.insert(calls.end(), more.begin(), more.end());
    Program program;
    for (const Call& call : calls) append(program, call);
    return program;
  }

  void append(Program& program, const Call& call) const {
    const int instance = plan_.placed[call.place];
    const BlockObject& what = object(instance);
    if (!program.ops.empty()) {
      Op& last = program.ops.back();
      // Objects are shared by structure, the sample time included, so one object has one rate.
      if (last.object == &what && last.phase == call.phase && last.place + last.count == call.place) {
        ++last.count;
        return;
      }
    }
    Op op;
    op.object = &what;
    op.self = what.self.get();
    op.phase = call.phase;
    op.on_double = what.type->kernels.on_double.sweep(call.phase);
    op.on_jet = what.type->kernels.on_jet.sweep(call.phase);
    op.first = plan_.map[instance];
    op.stride = static_cast<int>(what.specification->slots.size());
    op.count = 1;
    op.place = call.place;
    op.rate = plan_.rate_of[instance];
    program.ops.push_back(op);
  }

  /// Everything, level by level; the bits of a relation settle in its own level.
  void write_sweep() {
    std::vector<Call> calls;
    for (int node = 0; node < order_.nodes(); ++node) {
      if (order_.level(node) < 0) continue;
      const Endpoint e = order_.endpoint(node);
      const bool bit = slot(e).kind == SlotKind::relation;
      calls.push_back({order_.level(node), bit ? Phase::relations : Phase::outputs, place_of_[e.instance]});
    }
    std::ranges::sort(calls);
    calls.erase(std::unique(calls.begin(), calls.end()), calls.end());
    std::size_t done = 0;
    for (int level = 0; level < order_.levels(); ++level) {
      // A batch must not reach over levels: what it settles would come too late or too early.
      Program part;
      for (; done < calls.size() && calls[done].level == level; ++done) append(part, calls[done]);
      for (Op op : part.ops) {
        if (op.phase == Phase::relations) settle(op, level);
        plan_.sweep.ops.push_back(op);
      }
    }
  }

  void settle(Op& op, int level) {
    op.settle_first = static_cast<int>(plan_.sweep.settle.size());
    for (int k = 0; k < op.count; ++k) {
      const int instance = plan_.placed[op.place + k];
      for (int s = 0; s < op.stride; ++s) {
        const bool here = order_.level(order_.node(instance, s)) == level;
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
      if (object(plan_.placed[place]).specification->has(kind)) calls.push_back({last_level, phase, place});
    }
    return calls;
  }

  std::vector<Call> cone_calls(const std::vector<bool>& cone) const {
    std::vector<Call> calls;
    for (int node = 0; node < order_.nodes(); ++node) {
      if (cone[node])
        calls.push_back({order_.level(node), Phase::outputs, place_of_[order_.endpoint(node).instance]});
    }
    return calls;
  }

  /// Finds the outputs that move during a step: unsampled, and behind them time or a state. What does not
  /// move keeps the value of the last sweep, so minor steps need not compute it.
  void find_moving() {
    std::vector<std::vector<Endpoint>> of_level(order_.levels());
    for (int node = 0; node < order_.nodes(); ++node) {
      const Endpoint e = order_.level(node) < 0 ? Endpoint{} : order_.endpoint(node);
      const bool output = e.connected() && slot(e).kind == SlotKind::output;
      if (output && plan_.rate_of[e.instance] < 0) of_level[order_.level(node)].push_back(e);
    }
    for (const auto& endpoints : of_level) {
      for (const Endpoint e : endpoints) {
        moves_[order_.node(e)] = std::ranges::any_of(object(e.instance).reads[e.slot], [&](int read) {
          return moves({e.instance, read});
        });
      }
    }
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
  std::vector<bool> moves_;  // of each node
};

}  // namespace

void write_programs(Plan& plan, const Order& order) { ProgramWriter(plan, order).run(); }

}  // namespace flyball
