#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "models/plan.h"
#include "studies/metrics/metric.h"
#include "studies/metrics/requirement.h"

namespace flyball {

/// A parameter of a model, "block.setting", or "simulation.key" (method, rtol, atol, stop, step, max_step,
/// log_interval) with the value that a study gives it.
struct Setting {
  std::string name;
  /// A number goes into its slot [SI]. A text takes the model to be read again with it, as --set does: modes,
  /// sample times, formulas over the model's parameters.
  std::variant<double, std::string> value = 0.0;
  int model = -1;  // number in Study::models of the one that it is for; -1: all of them

  bool operator==(const Setting&) const = default;
};

/// A model of a study, planned as its file has it.
struct StudyModel {
  std::string name;  // unique in the study: the file's stem, or what the study calls it
  std::string file;  // path that opens it
  std::string text;
  std::shared_ptr<const Plan> plan;
  std::vector<Metric> metrics;            // one for each name of Study::metrics
  std::vector<Requirement> requirements;  // one for each name of Study::requirements
};

/// A case or a scenario: a name, and what it sets.
struct Choice {
  std::string name;
  std::vector<Setting> settings;
  /// Settings that another part of the study finds first: "fit.NAME", or "pareto.NAME" with `pick`.
  std::string from;
  std::string pick;  // of a front: "knee", or the objective that is least
  Position at;
};

/// One axis of [sweep]: what it sets, to which values.
struct Axis {
  std::string name;
  std::vector<std::variant<double, std::string>> values;
};

/// All values of all axes in all combinations, the last axis fastest; or value k of each axis together.
struct SweepGrid {
  std::vector<Axis> axes;
  bool zipped = false;

  /// 1 without axes.
  std::int64_t points() const;
};

/// How a parameter of [monte_carlo] is spread [SI].
struct Distribution {
  enum class Kind { uniform, normal, lognormal, triangular, choice };

  Kind kind = Kind::uniform;
  double a = 0.0;                         // lower; mean; median
  double b = 1.0;                         // upper; standard deviation; factor of one standard deviation
  double c = 0.0;                         // triangular: mode
  std::optional<double> lowest, highest;  // truncated there, by drawing within
  std::vector<double> values;             // choice

  /// The value below which the part `p` of all values lies, 0 < p < 1.
  double quantile(double p) const;
};

struct MonteCarlo {
  enum class Sampling { random, latin_hypercube, sobol };

  int runs = 1;
  Sampling sampling = Sampling::random;
  std::vector<std::pair<std::string, Distribution>> spread;  // by name of the parameter
};

/// A parameter that a fit or a front looks for [SI].
struct Sought {
  std::string name;
  double lower = 0.0, upper = 0.0;  // fits: may be infinite
  std::optional<double> start;      // default: the model's value
  double scale = 0.0;               // its typical size; 0: from the bounds and the start
};

/// Data that one run of the model is compared with.
struct FitExperiment {
  struct Match {
    std::string signal;  // logged column
    std::string column;  // of the file
    double weight = 1.0;
  };

  std::string name;
  std::string data;  // path that opens it; empty: requirements alone
  std::vector<Match> matches;
  std::vector<Setting> settings;
};

/// [fit.NAME]
struct FitDefinition {
  std::string name;
  int model = 0;
  std::vector<Sought> parameters;
  std::vector<FitExperiment> experiments;
  std::vector<int> requirements;   // numbers in Study::requirements that are residuals, too
  std::vector<int> minimise;       // numbers in Study::metrics whose value is a residual (sum of squares)
  std::string loss = "squared";    // "squared", "huber", "cauchy", "soft_l1"
  double loss_scale = 1.0;         // residual at which a robust loss begins to yield
  int starts = 1;                  // of a multi-start, the first from the start values
  std::string gradient = "exact";  // or "numeric"
  int max_iterations = 100;
  Position at;
};

/// [pareto.NAME]
struct ParetoDefinition {
  std::string name;
  int model = 0;
  std::string algorithm = "nsga2";  // "nsga2", "moead", "nspso", "mopso"
  long evaluations = 10000;
  int population = 100;
  std::vector<Sought> parameters;
  std::vector<int> minimise;  // numbers in Study::metrics
  std::vector<int> maximise;
  std::vector<int> requirements;  // numbers in Study::requirements that must hold
  std::vector<int>
      scenarios;  // numbers in Study::scenarios: objectives are means over them; empty: the first
  std::vector<double> reference;  // point of the hypervolume; empty: from the front
  std::string pick = "knee";      // of what is written back: "knee", an objective, or weights
  std::vector<double> weights;
  Position at;
};

/// [bisect.NAME]: between two values of a parameter, the one at which a requirement begins to be broken.
struct BisectDefinition {
  std::string name;
  int model = 0;
  std::string parameter;
  double lower = 0.0, upper = 0.0;  // [SI]; the requirement holds at one end and is broken at the other
  double tolerance = 0.0;           // of the parameter [SI]
  int requirement = 0;              // number in Study::requirements
  Position at;
};

/// [[plot]]
struct PlotDefinition {
  std::string title;
  std::vector<std::string> signals;  // over time; one panel each
  std::string x;                     // else a logged signal, or a metric, against those of `signals`
  std::string by = "case";           // one curve a "case", "scenario", "sweep" or "model"
  std::string scenario;              // which one where curves are by case; empty: the first
};

/// A study file, read and checked. Immutable.
struct Study {
  std::string file;
  std::string text;
  std::string title;
  std::uint64_t seed = 1;
  std::vector<StudyModel> models;
  std::vector<Choice> cases;      // at least one: "model", which sets nothing
  std::vector<Choice> scenarios;  // at least one: "nominal", which sets nothing
  SweepGrid sweep;
  MonteCarlo monte_carlo;
  std::vector<std::pair<std::string, std::string>> metrics;       // name, text
  std::vector<std::pair<std::string, std::string>> requirements;  // name, text
  std::vector<FitDefinition> fits;
  std::vector<ParetoDefinition> fronts;
  std::vector<BisectDefinition> bisections;
  std::vector<PlotDefinition> plots;
};

/// Whether a file is a study, not a model: it has a section [study].
bool is_study(std::string_view text);

/// Reads a study and its models. Reports everything that is wrong to `diagnostics`, in the models' files,
/// too; then the result is empty. `text` is the content of `diagnostics.file()`.
std::optional<Study> read_study(std::string_view text, Diagnostics& diagnostics);

}  // namespace flyball
