#include "studies/engine/bisect.h"

#include <cmath>

namespace flyball {
namespace {

/// One limit on its way: the ends of its interval, and what the requirement says there.
struct Search {
  BisectLimit limit;
  std::vector<Setting> settings;
  double lower = 0.0, upper = 0.0;
  bool lower_holds = false;
  bool open = true;  // the ends differ, and are too far apart

  double middle() const { return 0.5 * (lower + upper); }

  void narrow(bool middle_holds, double tolerance) {
    const double at = middle();
    (middle_holds == lower_holds ? lower : upper) = at;
    const double next = middle();
    // Where doubles end, so does the interval.
    open = upper - lower > tolerance && next > lower && next < upper;
  }

  BisectLimit finish() {
    if (!limit.reason.empty()) return limit;
    limit.value = middle();
    limit.holds = lower_holds ? lower : upper;
    limit.broken = lower_holds ? upper : lower;
    return limit;
  }
};

class Bisection {
 public:
  Bisection(const Study& study, const BisectDefinition& definition, Evaluator& evaluator,
            const EvaluatorOptions& options)
      : study_(study), definition_(definition), evaluator_(evaluator), options_(options) {}

  BisectResult run(const std::vector<Choice>& cases) {
    for (std::size_t c = 0; c < cases.size(); ++c) {
      for (std::size_t s = 0; s < study_.scenarios.size(); ++s)
        searches_.push_back(begin(cases[c], static_cast<int>(c), static_cast<int>(s)));
    }
    look_at_ends();
    while (halve()) {
    }
    BisectResult result{definition_.name, definition_.parameter, {}};
    for (Search& search : searches_) result.limits.push_back(search.finish());
    return result;
  }

 private:
  Search begin(const Choice& choice, int number, int scenario) const {
    Search search;
    search.limit.choice = number;
    search.limit.scenario = scenario;
    search.lower = definition_.lower;
    search.upper = definition_.upper;
    for (const auto* settings : {&study_.scenarios[scenario].settings, &choice.settings}) {
      for (const Setting& setting : *settings) {
        if (setting.model < 0 || setting.model == definition_.model) search.settings.push_back(setting);
      }
    }
    return search;
  }

  /// Whether the requirement holds at one point of each of these searches.
  std::vector<bool> holds(const std::vector<Search*>& searches, const std::vector<double>& points) {
    std::vector<RunRequest> requests;
    for (std::size_t k = 0; k < searches.size(); ++k) {
      RunRequest request{definition_.model, searches[k]->settings, study_.seed};
      request.settings.push_back({definition_.parameter, points[k]});
      requests.push_back(std::move(request));
      ++searches[k]->limit.runs;
    }
    std::vector<bool> result;
    for (const RunRecord& record : evaluator_.run(requests, options_)) {
      result.push_back(record.status == RunStatus::finished &&
                       record.verdicts[static_cast<std::size_t>(definition_.requirement)].passed);
    }
    return result;
  }

  void look_at_ends() {
    std::vector<Search*> all;
    std::vector<double> lower, upper;
    for (Search& search : searches_) {
      all.push_back(&search);
      lower.push_back(search.lower);
      upper.push_back(search.upper);
    }
    const auto below = holds(all, lower), above = holds(all, upper);
    for (std::size_t k = 0; k < all.size(); ++k) {
      all[k]->lower_holds = below[k];
      if (below[k] != above[k]) continue;
      all[k]->open = false;
      all[k]->limit.reason = below[k] ? "the requirement holds at both ends of the range"
                                      : "the requirement is broken at both ends of the range";
    }
  }

  /// False when no search is open.
  bool halve() {
    std::vector<Search*> open;
    std::vector<double> points;
    for (Search& search : searches_) {
      if (!search.open) continue;
      open.push_back(&search);
      points.push_back(search.middle());
    }
    if (open.empty() || (options_.cancelled && options_.cancelled())) return false;
    const auto found = holds(open, points);
    for (std::size_t k = 0; k < open.size(); ++k) open[k]->narrow(found[k], definition_.tolerance);
    return true;
  }

  const Study& study_;
  const BisectDefinition& definition_;
  Evaluator& evaluator_;
  const EvaluatorOptions& options_;
  std::vector<Search> searches_;
};

}  // namespace

BisectResult run_bisect(const Study& study, const BisectDefinition& definition,
                        const std::vector<Choice>& cases, Evaluator& evaluator,
                        const EvaluatorOptions& options) {
  return Bisection(study, definition, evaluator, options).run(cases);
}

}  // namespace flyball
