#pragma once

#include <string>
#include <vector>

#include "solvers/plan_system.h"

namespace flyball {

/// How often a run called the programs of its plan.
struct ProgramCalls {
  long rates = 0, jacobians = 0, zeros = 0, logs = 0, sweeps = 0;
  std::vector<long> hits;  // of each rate
};

/// The time that calls of one instance took. Work that is not done block by block, such as a matrix that
/// stands for all rates, has a name in parentheses and no type.
struct BlockTime {
  std::string name;
  std::string type;
  double seconds = 0.0;
};

/// Measures the time of one call of each block, at some points of a run, on a copy of its workspace, so that
/// the run itself is neither slowed nor disturbed.
///
/// Short calls are repeated, so these are times with warm caches. Instances that are called as one batch
/// share its time equally.
class BlockTimes {
 public:
  explicit BlockTimes(const Plan& plan);
  BlockTimes(const BlockTimes&) = delete;
  BlockTimes& operator=(const BlockTimes&) = delete;

  void sample(const Workspace<double>& workspace, const Stepper<double>& stepper);
  int points() const { return points_; }
  /// Calls times the mean time of a call, longest first.
  std::vector<BlockTime> of(const ProgramCalls& calls) const;

 private:
  /// What is known of one program: the time of each operation, or of the matrix in its place. Sums over
  /// points.
  struct Timed {
    explicit Timed(const Program& timed) : program(timed), operations(timed.ops.size()) {}

    const Program& program;
    std::vector<double> operations;
    double matrix = 0.0;
    bool is_matrix = false;
  };

  void sample_program(Timed& timed);
  void sample_matrix(Timed& timed, AffineProgram& affine, Workspace<double>::Affine& map);

  const Plan& plan_;
  Workspace<double> probe_;
  PlanSystem system_;
  AffineProgram rates_matrix_, zeros_matrix_, logs_matrix_;
  Timed rates_, zeros_, logs_, sweep_;
  double jacobian_ = 0.0;
  int jacobian_points_ = 0;
  std::vector<double> states_, results_, entries_;
  int points_ = 0;
};

}  // namespace flyball
