#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "solvers/instant.h"
#include "solvers/jet_system.h"
#include "solvers/sensitivities.h"

namespace flyball {

/// A parameter that a pass differentiates by.
struct SensitivitySeed {
  std::string name;
  int slot = -1;
  int parameter = -1;  // number in the request
  double scale = 1.0;  // derivatives inside a pass are by parameter / scale
};

/// Values and derivatives that were asked for, as Sensitivities gives them.
struct SensitivityTable {
  std::vector<double> times;
  std::vector<int> slots;  // of the signals
  int parameters = 0;
  std::vector<double> values, derivatives;
  std::vector<SensitivityWarning> warnings;
};

/// Where the last step on numbers began: tells how fast a signal came to its threshold.
struct Approach {
  double time = 0.0;
  std::vector<double> zeros;  // relations and crossings
};

/// Follows a run on numbers with Jets for up to three parameters: from instant to instant with its own steps,
/// through an instant by doing the same again.
class SensitivityPass {
 public:
  static constexpr int most_seeds = 3;  // the fourth direction of a Jet is time

  /// Steps by BDF when `stiff`, else by Dormand-Prince.
  SensitivityPass(const Plan& plan, const StepperOptions& options, bool stiff, SensitivityTable& table);
  SensitivityPass(const SensitivityPass&) = delete;
  SensitivityPass& operator=(const SensitivityPass&) = delete;

  /// Begins beside a run that has its parameters, and nothing else yet. `run` must outlive its end; at
  /// most most_seeds seeds.
  void start(const Workspace<double>& run, std::vector<SensitivitySeed> seeds);
  /// The instant of the run, in the order of InstantListener.
  void begins(const Due& due, const Zeros& zeros, const Approach& approach);
  void swept(const Due* hits);
  void handled(const std::vector<HandlerCall>& calls);
  void ends();
  /// Goes on to the end of the run.
  void finish(double stop);

 private:
  using Derivatives = decltype(Jet::v);
  /// Something that happens at an instant, whose time depends on the parameters.
  struct Cause {
    enum class Kind { ticks, alarm, zero };
    Kind kind = Kind::ticks;
    int number = -1;  // alarm, or as Zeros counts
    Derivatives time = Derivatives::Zero();
  };

  void integrate(double t);
  void begin_at_start(const Due& due);
  void find_causes(const Due& due, const Zeros& zeros, const Approach& approach);
  void find_slopes();
  Derivatives zero_time(int slot, const Approach& approach);
  void lose(int direction, int slot);
  bool same_time(const Cause& a, const Cause& b) const;
  void play_early(const Cause& cause, const Due& due, const Zeros& zeros);
  void collect_calls(const Cause& cause, const Due& due, const Zeros& zeros);
  void commit_calls();
  std::string name(const Cause& cause, const Zeros& zeros) const;

  void shift_to_instant(const Derivatives& time);
  void shift_back();
  void sweep(const Due* hits, const Zeros* settle_beside = nullptr);
  void call_all(std::pair<int, int> ops, const Due* hits, const Zeros* settle_beside);
  void settle(int slot, const Zeros& located);
  void take_outputs(const Op& op);
  void record(std::size_t k);
  void record_instant();
  void warn(SensitivityWarning::Kind kind, int direction, const std::string& what);

  const Plan& plan_;
  std::vector<std::string> names_;  // of the seeds
  SensitivityTable& table_;
  const Workspace<double>* run_ = nullptr;
  Workspace<Jet> jets_;
  JetSystem system_;
  std::unique_ptr<Stepper<Jet>> stepper_;
  Handlers<Jet> handlers_;
  std::vector<SensitivitySeed> seeds_;
  std::vector<bool> lost_;  // directions behind a grazing event
  std::vector<Jet> flow_;
  std::vector<Cause> causes_;
  std::vector<HandlerCall> calls_;
  std::vector<HandlerCall> early_;  // calls of this instant that were made before the others
  bool early_hits_ = false;
  Derivatives shift_ = Derivatives::Zero();  // of the present instant
  double time_ = 0.0;
  bool running_ = false;  // the first instant has passed
  bool stale_ = false;    // a commit came after the last sweep
  std::size_t next_ = 0;  // time in the table
};

}  // namespace flyball
