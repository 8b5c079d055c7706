#pragma once

#include <functional>
#include <string>
#include <vector>

#include "studies/engine/evaluator.h"

namespace flyball {

/// One point of a front: parameters [SI], and objectives as the study defines them (those to be maximised
/// keep their sign).
struct ParetoPoint {
  std::vector<double> parameters;
  std::vector<double> objectives;
};

/// A front: points that no other point found is better than in every objective, ordered by the first one.
struct ParetoResult {
  std::string name;
  std::vector<std::string> parameters, objectives;
  std::size_t minimised = 0;  // so many objectives are minimised, those behind them maximised
  std::vector<std::string> parameter_units, objective_units;
  std::vector<ParetoPoint> front;
  std::vector<double> reference;  // of the hypervolume
  double hypervolume = 0.0;
  double spread = 0.0;  // Deb's Delta: 0 is even
  long evaluations = 0;
  long failed = 0;                        // runs that ended without numbers
  int picked = -1;                        // number in the front
  std::vector<Setting> settings() const;  // of the point that was picked
};

/// Finds the front that [pareto.NAME] asks for. The same seed gives the same front with any number of
/// threads. `progress` gets the part done and ends the search by giving false.
ParetoResult run_pareto(const Study& study, const ParetoDefinition& definition, Evaluator& evaluator,
                        int threads = 1, const std::function<bool(double)>& progress = {});

/// The number of the point of a front that `pick` names: "knee", an objective's name, or by weights.
int pick_point(const ParetoResult& front, const std::string& pick, const std::vector<double>& weights);

}  // namespace flyball
