#pragma once

#include <cstdint>

#include "studies/engine/evaluator.h"
#include "studies/language/sampling.h"

namespace flyball {

/// Which run of a study this is: numbers of model, case, scenario, sweep point and sample.
struct RunPlace {
  int model = 0;
  int choice = 0;  // of Study::cases
  int scenario = 0;
  std::int64_t sweep = 0;
  int sample = 0;
};

/// All runs of a study, made as they are asked for: a table of any size takes no memory. In their order the
/// sample changes fastest, then sweep point, scenario, case and model. Sample k has the same seed and the
/// same draws for every case, scenario and sweep point, so that differences between cases are paired.
class RunTable {
 public:
  /// `cases` are those of the study with what fits and fronts have found filled in.
  RunTable(const Study& study, std::vector<Choice> cases);

  std::int64_t size() const;
  RunPlace place(std::int64_t run) const;
  /// Settings in the order: sweep, samples, scenario, case; later ones win.
  RunRequest request(std::int64_t run) const;

 private:
  std::vector<Setting> sweep_settings(std::int64_t point) const;

  const Study* study_;
  std::vector<Choice> cases_;
  Sampler sampler_;
};

}  // namespace flyball
