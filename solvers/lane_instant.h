#pragma once

#include <utility>
#include <vector>

#include "solvers/lane_events.h"
#include "solvers/plan_system.h"

namespace flyball {

/// What is due at an instant of a group.
struct LaneDue {
  struct Alarm {
    int number;
    LaneMask lanes;
  };
  std::vector<unsigned char> rates;  // of each rate: whether it hits, in all lanes
  std::vector<Alarm> alarms;
  bool hits = false;
  bool located = false;
};

/// Carries out an instant in all lanes at once, as Instant does for one run. The sweep is common; handlers
/// commit in the lanes that they are due in. A run that does not come to an end, or whose numbers are not
/// finite, is dropped.
template <Isa isa>
class LaneInstant {
 public:
  LaneInstant(LaneGroup<isa>& group, LaneEvents<isa>& events);

  void run(const LaneDue& due);
  void ask_schedules();
  /// The earliest alarm of the runs that go on; `never` when none is set.
  double next_alarm() const;

 private:
  using T = Lanes<isa>;
  enum class Method { on_sample, on_time, on_crossing };
  struct Handler {
    int instance;
    Method method;
    int local;  // crossing
    LaneMask lanes;
  };

  /// What rates that hit together call: found once for each set of them.
  struct Hits {
    struct Sweep {
      typename LaneGroup<isa>::Call call;
      int settle_first, settle_count;  // Program::settle
    };
    struct Sample {
      typename Kernels<T>::Handler kernel;
      const void* self;
      const int* index;
    };
    std::vector<unsigned char> rates;
    std::vector<Sweep> sweeps;
    std::vector<Sample> samples;
    std::vector<std::pair<int, int>> staged;  // slots that these write: first, and how many
    bool moves_states = false;
    bool moves_crossings = false;  // something that a crossing reads is computed anew
  };

  void add_staged(Hits& hits, int slot) const;
  bool moves_crossings(const Hits& hits) const;
  Hits hits_of(const std::vector<unsigned char>& rates) const;
  /// Valid until the next call; null: no rate hits.
  const Hits& find_hits(const LaneDue* due);
  void sweep(const Hits& hits);
  void sample(const Hits& hits);
  void collect_due(const LaneDue& due);
  void collect_crossings(const std::vector<typename LaneEvents<isa>::Change>& changes);
  void run_handlers();
  void run_handler(const Handler& handler);
  bool commit();
  void rearm();

  LaneGroup<isa>& group_;
  LaneEvents<isa>& events_;
  std::vector<Hits> known_hits_;
  std::vector<int> staged_first_, staged_;  // slots of states and held values of each instance
  std::vector<Handler> handlers_;
  std::vector<unsigned char> is_staged_;  // of each instance, in this round
  std::vector<int> touched_;              // instances staged in this round
  std::vector<T> values_before_, next_before_;
  Workspace<double> alone_;  // one lane, for its derivatives
  PlanSystem system_;
  std::vector<double> rates_;
};

extern template class LaneInstant<Isa::baseline>;
extern template class LaneInstant<Isa::avx2>;

}  // namespace flyball
