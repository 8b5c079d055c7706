#pragma once

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "blocks/jet_kernels.h"
#include "models/plan.h"
#include "solvers/errors.h"
#include "solvers/simulator.h"
#include "tests/blocks/table_settings.h"
#include "tests/catch.h"

namespace flyball::test {

/// A planned model with its [simulation].
struct Model {
  std::shared_ptr<const Plan> plan;
  SimulationSettings settings;
};

/// All diagnostics, one a line.
std::string text_of(const Diagnostics& diagnostics);

/// Reads and plans the text of a model, called model.toml. Throws std::invalid_argument with all diagnostics.
Model read_model(std::string_view text);
/// The same from a file.
Model load_model(const std::string& file, const std::vector<Override>& overrides = {});
/// All shipped models, in the order of their names.
std::vector<std::string> model_files();
/// The diagnostics of a model that cannot be read or planned.
std::string refusal_of(std::string_view text);

/// Builds a diagram from block types that no model file can name: those of the tests.
class DiagramBuilder {
 public:
  template <class B>
  void add(const std::string& name, Keys keys = {}) {
    static const BlockType type = describe<B>("TestBlock", "tests");
    add(type, name, std::move(keys));
  }
  void add(const std::string& type, const std::string& name, Keys keys = {});
  /// From "block.port" to "block.port", both of one element.
  void wire(std::string_view from, std::string_view to);
  void log(const std::string& port);

  SimulationSettings simulation;
  Model build();

 private:
  void add(const BlockType& type, const std::string& name, Keys keys);
  Endpoint end(std::string_view port) const;

  Diagram diagram_;
};

/// One run of a model, whose numbers go by name.
class Run {
 public:
  explicit Run(Model model, LogOptions log = {})
      : model_(std::move(model)), simulator_(model_.plan, model_.settings, log) {}
  explicit Run(std::string_view text, LogOptions log = {}) : Run(read_model(text), log) {}

  Run& finish() {
    simulator_.run();
    return *this;
  }
  /// Runs until the simulator throws; a run to the end is a failure.
  SimulationError stop();

  Simulator& simulator() { return simulator_; }
  const Plan& plan() const { return *model_.plan; }
  double time() const { return simulator_.time(); }
  bool advance() { return simulator_.advance(); }
  /// The times at which calls of `advance` ended, to the stop time.
  std::vector<double> advance_times();

  /// "block.slot": the present number.
  double operator[](std::string_view name) const { return simulator_.workspace().values[slot(name)]; }
  /// "block.relation"
  bool on(std::string_view name) const {
    return simulator_.workspace().bits[slot(name) - model_.plan->layout.first_relation] != 0;
  }

  std::vector<double> times() const;
  std::vector<double> column(const std::string& name) const;
  /// The logged value at the last row of this time; throws when there is no row.
  double logged(const std::string& name, double t) const;

 private:
  int slot(std::string_view name) const;
  int column_number(const std::string& name) const;

  Model model_;
  Simulator simulator_;
};

}  // namespace flyball::test
