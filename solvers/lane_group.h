#pragma once

#include <vector>

#include "models/plan.h"
#include "solvers/lane_arithmetic.h"
#include "solvers/workspace.h"

namespace flyball {

/// The numbers of the runs of one group, a lane each, and the programs of a plan that compute on them.
template <Isa isa>
class LaneGroup {
 public:
  using T = Lanes<isa>;
  using Arithmetic = LaneArithmetic<isa>;
  struct Call {
    typename Kernels<T>::Sweep sweep;
    const void* self;
    const int* index;
    int stride, count;
  };
  using Calls = std::vector<Call>;

  explicit LaneGroup(const Plan& plan);
  LaneGroup(const LaneGroup&) = delete;
  LaneGroup& operator=(const LaneGroup&) = delete;

  /// Gives a lane the numbers of an initialised run; the run takes part where `counts`.
  void load(int lane, const Workspace<double>& from, bool counts);
  /// The numbers and bits of a lane.
  void store(int lane, Workspace<double>& to) const;

  LaneMask active() const { return active_; }
  /// Lanes that must not go on with the others.
  void drop(LaneMask lanes) { active_ &= static_cast<LaneMask>(~lanes); }

  double time() const { return values[0].lane(0); }
  void place(double t) { values[0] = T(t); }
  T* states() { return values.data() + plan.layout.first_state; }

  Frame<T> frame(T* to_rates = nullptr);
  void run(const Calls& calls, T* to_rates = nullptr);
  static void run(const Call& call, const Frame<T>& frame) {
    call.sweep(call.self, frame, call.index, call.stride, call.count);
  }
  const Kernels<T>& kernels(int instance) const {
    return plan.instance(instance).object->type->kernels.template on<T>();
  }
  /// Drops the lanes in which an unsampled block made something of what must be finite that is not.
  void drop_bad_outputs();

  const Plan& plan;
  std::vector<T> values, next;     // between two instants `next` holds what is staged, as it is
  std::vector<LaneMask> bits;      // of relations
  std::vector<LaneMask> up, down;  // the sides of crossings; neither as long as it is not known
  std::vector<std::shared_ptr<const void>> objects, next_objects;  // of structure, so common to all lanes
  Calls sweep, rates, zeros, zeros_rest, logs, crossings, schedules;

 private:
  Calls bind(const Program& program) const;

  LaneMask active_ = 0;
};

extern template class LaneGroup<Isa::baseline>;
extern template class LaneGroup<Isa::avx2>;

}  // namespace flyball
