#include "studies/pareto/pareto.h"

#include <fmt/format.h>

#include <algorithm>
#include <pagmo/algorithm.hpp>
#include <pagmo/algorithms/moead.hpp>
#include <pagmo/algorithms/nsga2.hpp>
#include <pagmo/algorithms/nspso.hpp>
#include <pagmo/bfe.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>
#include <pagmo/utils/hypervolume.hpp>
#include <stdexcept>

#include "studies/parameter_unit.h"
#include "studies/pareto/front_search.h"
#include "studies/pareto/mopso.h"

namespace flyball {
namespace {

/// The search as pagmo wants to see a problem. pagmo copies it, so it only points.
struct Problem {
  FrontSearch* search = nullptr;

  pagmo::vector_double fitness(const pagmo::vector_double& decision) const {
    return search->fitness(decision);
  }
  std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const {
    return {search->lower(), search->upper()};
  }
  pagmo::vector_double::size_type get_nobj() const { return search->objectives(); }
};

/// Hands a whole generation over at once, so that its runs share threads and lanes.
struct Batch {
  FrontSearch* search = nullptr;
  pagmo::vector_double operator()(const pagmo::problem&, const pagmo::vector_double& decisions) const {
    return search->fitness(decisions);
  }
};

pagmo::algorithm make_algorithm(const ParetoDefinition& definition, unsigned generations, unsigned seed,
                                const pagmo::bfe& batch) {
  if (definition.algorithm == "nsga2") {
    pagmo::nsga2 nsga2(generations);
    nsga2.set_seed(seed);
    nsga2.set_bfe(batch);
    return pagmo::algorithm(nsga2);
  }
  if (definition.algorithm == "nspso") {
    pagmo::nspso nspso(generations);
    nspso.set_seed(seed);
    nspso.set_bfe(batch);
    return pagmo::algorithm(nspso);
  }
  if (definition.algorithm == "mopso") {
    Mopso mopso(generations, seed);
    mopso.set_bfe(batch);
    return pagmo::algorithm(mopso);
  }
  if (definition.algorithm == "moead") {
    // Each solution is tried on its neighbours as soon as it is there: one evaluation after the other.
    const auto neighbours = std::min<unsigned>(20, static_cast<unsigned>(definition.population) - 1);
    return pagmo::algorithm(pagmo::moead(generations, "low discrepancy", "tchebycheff", neighbours, 1.0, 0.5,
                                         20.0, 0.9, 2, true, seed));
  }
  if (definition.algorithm == "mopso") {
    Mopso mopso(generations, seed);
    mopso.set_bfe(batch);
    return pagmo::algorithm(mopso);
  }
  throw std::invalid_argument(fmt::format("there is no algorithm \"{}\"", definition.algorithm));
}

void search(FrontSearch& front_search, const ParetoDefinition& definition, std::uint64_t seed) {
  const auto size = static_cast<unsigned>(definition.population);
  const auto generations =
      static_cast<unsigned>(std::max(0L, definition.evaluations / definition.population - 1));
  // The generators of pagmo are seeded by 32 bits.
  const auto short_seed = static_cast<unsigned>(seed ^ (seed >> 32));
  const pagmo::bfe batch(Batch{&front_search});
  try {
    const pagmo::algorithm algorithm = make_algorithm(definition, generations, short_seed, batch);
    algorithm.evolve(pagmo::population(pagmo::problem(Problem{&front_search}), batch, size, short_seed));
  } catch (const SearchEnded&) {  // what was found so far is the answer
  }
}

/// Behind the front by a tenth of its extent: every point of it counts.
std::vector<double> reference_behind(const std::vector<ParetoPoint>& front) {
  const ObjectiveRanges ranges(front);
  std::vector<double> reference = ranges.highest;
  for (std::size_t k = 0; k < reference.size(); ++k) {
    const double range = ranges.highest[k] - ranges.lowest[k];
    reference[k] += range > 0.0 ? 0.1 * range : 1.0;
  }
  return reference;
}

double hypervolume_of(const std::vector<ParetoPoint>& front, const std::vector<double>& reference) {
  std::vector<pagmo::vector_double> counted;
  for (const ParetoPoint& point : front) {
    bool inside = true;
    for (std::size_t k = 0; k < reference.size(); ++k) inside &= point.objectives[k] < reference[k];
    if (inside) counted.push_back(point.objectives);
  }
  return counted.empty() ? 0.0 : pagmo::hypervolume(counted).compute(reference);
}

ParetoResult describe(const Study& study, const ParetoDefinition& definition) {
  ParetoResult result;
  result.name = definition.name;
  result.minimised = definition.minimise.size();
  const StudyModel& model = study.models[definition.model];
  for (const Sought& sought : definition.parameters) {
    result.parameters.push_back(sought.name);
    result.parameter_units.push_back(parameter_unit(*model.plan, sought.name));
  }
  std::vector<int> metrics = definition.minimise;
  metrics.insert(metrics.end(), definition.maximise.begin(), definition.maximise.end());
  for (const int metric : metrics) {
    result.objectives.push_back(study.metrics[metric].first);
    result.objective_units.push_back(model.metrics[metric].unit());
  }
  return result;
}

void require_possible(const ParetoDefinition& definition) {
  const bool multiple_of_four = definition.population % 4 == 0;
  if (definition.algorithm == "nsga2" && (!multiple_of_four || definition.population < 8)) {
    throw std::invalid_argument(
        fmt::format("nsga2 pairs its population in fours: expected a multiple of 4 from 8 on, found {}",
                    definition.population));
  }
  if (definition.population < 4) {
    throw std::invalid_argument(
        fmt::format("a population of {} is too small: expected at least 4", definition.population));
  }
}

}  // namespace

ParetoResult run_pareto(const Study& study, const ParetoDefinition& definition, Evaluator& evaluator,
                        int threads, const std::function<bool(double)>& progress) {
  require_possible(definition);
  ParetoResult result = describe(study, definition);
  FrontSearch front_search(study, definition, evaluator, threads, progress);
  search(front_search, definition, study.seed);
  result.evaluations = front_search.evaluations();
  result.failed = front_search.failed();
  result.front = front_search.archive().thinned(static_cast<std::size_t>(definition.population));
  if (result.front.empty()) return result;
  std::vector<double> reference = definition.reference;
  turn_maximised(reference, reference.empty() ? 0 : result.minimised);
  if (reference.empty()) reference = reference_behind(result.front);
  result.hypervolume = hypervolume_of(result.front, reference);
  result.spread = spread(result.front);
  for (ParetoPoint& point : result.front) turn_maximised(point.objectives, result.minimised);
  turn_maximised(reference, result.minimised);
  result.reference = std::move(reference);
  result.picked = pick_point(result, definition.pick, definition.weights);
  return result;
}

}  // namespace flyball
