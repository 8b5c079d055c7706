#pragma once

#include <vector>

#include "solvers/workspace.h"

namespace flyball {

/// One handler of one instance that an instant calls.
struct HandlerCall {
  enum class Method { on_sample, on_time, on_crossing };

  int instance = -1;
  Method method = Method::on_sample;
  int local = 0;  // crossing: slot of the block

  bool operator==(const HandlerCall&) const = default;
};

/// Runs the handlers of an instant and commits what they staged. All handlers of one round read the same
/// sweep; two of one block see each other's values.
template <class T>
class Handlers {
 public:
  Handlers(const Plan& plan, Workspace<T>& workspace);

  void run(const std::vector<HandlerCall>& calls);
  /// The first slot whose staged value is not finite; -1 when there is none.
  int bad_slot() const;
  /// Returns whether anything changed that an unsampled block can see: a sampled block's held values show at
  /// its hits only. On Jets a derivative is such a change, too.
  bool commit();

 private:
  void run_again(const HandlerCall& call);
  void run_one(const HandlerCall& call);
  T& next(int slot) { return workspace_.next[slot - plan_.layout.first_state]; }
  const T& next(int slot) const { return workspace_.next[slot - plan_.layout.first_state]; }

  const Plan& plan_;
  Workspace<T>& workspace_;
  std::vector<int> staged_first_, staged_;  // slots of states and held values of each instance
  std::vector<unsigned char> is_staged_;    // of each instance, in this round
  std::vector<int> touched_;                // instances staged in this round
  std::vector<T> saved_;
};

}  // namespace flyball
