#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "blocks/registry.h"
#include "models/language/diagnostics.h"

namespace flyball {

/// Where a parameter's number comes from.
struct Binding {
  enum class Kind { literal, parameter, formula };

  Kind kind = Kind::literal;
  double value = 0.0;                      // literal, SI
  std::optional<Dimension> unit;           // literal that was written with a unit
  int parameter = -1;                      // index into Diagram::parameters: same slot, no copy
  std::shared_ptr<const Formula> formula;  // operand k is the parameter operands[k]
  std::vector<int> operands;
  Position at;
};

/// One entry of [parameters], of the model or of a subsystem. A formula only uses parameters that stand
/// before it in Diagram::parameters.
struct Parameter {
  std::string name;  // with the path of its subsystem: "motor.R"
  Binding binding;
  Range range;
  std::string unit;                   // as declared, "any" without one
  std::optional<Dimension> declared;  // by `unit`, besides what its value says
  std::string doc;
  bool structural = false;  // it fixed a shape or a sample time: changing it takes a new diagram
};

/// An output slot of an instance.
struct Endpoint {
  int instance = -1;
  int slot = -1;

  bool connected() const { return instance >= 0; }
  bool operator==(const Endpoint&) const = default;
};

/// One block of the diagram. Subsystems are unfolded: their blocks stand here, their ports are gone.
struct Instance {
  std::string name;                                 // with the path of its subsystem: "motor.winding"
  std::shared_ptr<const BlockObject> object;        // shared by instances of equal type and structure
  std::vector<std::pair<int, Binding>> parameters;  // slot and binding, for each param slot
  std::vector<std::pair<int, Endpoint>> inputs;  // slot and source, for each (numeric or object) input slot
  Position at;
};

/// A signal that is recorded: one column of the result.
struct Logged {
  std::string name;  // "H", "robot.pose.x": also the column's name
  std::string unit;
  Endpoint source;
};

/// Where the solution of an algebraic loop is looked for at the start.
struct Guess {
  Endpoint of;
  double value = 0.0;
  Position at;
};

/// [simulation], with its defaults.
struct SimulationSettings {
  double stop = 10.0;
  std::string method = "auto";  // dp5, rk4, heun, euler, exact, discrete, adams, bdf; auto chooses
  double rtol = 1e-6;
  double atol = 1e-8;
  std::optional<double> max_step;        // default: a fiftieth of the run
  std::optional<double> step;            // of fixed-step methods; default: a thousandth of the run
  std::uint64_t seed = 1;                // of all random numbers
  std::optional<Rational> log_interval;  // default: a thousandth of the run
  bool refuse_loops = false;             // algebraic loops are solved, else refused
};

/// A file of values that a block reads.
struct DataFile {
  std::string name;
  std::string hash;  // of its bytes
};

/// A file that a model uses.
struct UsedFile {
  std::string name;  // its path, as messages show it
  std::string text;
};

/// A metric or a requirement of the model, in words that are read when it is run.
struct Question {
  std::string name;
  std::string text;
  std::vector<Position> at;  // of each byte of the text, and of its end
};

/// A checked model: every name resolved, every input connected, every structure constructed. Immutable.
struct Diagram {
  std::string file;
  std::string title;
  std::string source;                // where the model was published
  std::vector<UsedFile> used_files;  // besides `file`, in the order of first use
  std::vector<Parameter> parameters;
  std::vector<Instance> instances;
  std::vector<Logged> logged;
  std::vector<Guess> guesses;
  std::vector<DataFile> data_files;
  std::vector<Question> metrics, requirements;  // of the model itself, not of the files that it uses
  SimulationSettings simulation;

  int find_instance(std::string_view name) const;   ///< -1 when there is none
  int find_parameter(std::string_view name) const;  ///< -1 when there is none
};

/// A value given on the command line or by a study: a parameter of the model, or "block.parameter", where the
/// block may be a subsystem, or one inside it: "motor.R", "motor.winding.gain".
struct Override {
  std::string name;
  std::string value;  // an expression, as in a model file
};

/// Reads a model. Reports everything that is wrong to `diagnostics`; then the result is empty.
/// `text` is the content of `diagnostics.file()`; files that it uses are found from that path.
std::optional<Diagram> read_diagram(std::string_view text, Diagnostics& diagnostics,
                                    const std::vector<Override>& overrides = {});

/// The same from the file that `diagnostics` names. A file that cannot be read is an error at line 0.
std::optional<Diagram> read_diagram(Diagnostics& diagnostics, const std::vector<Override>& overrides = {});

}  // namespace flyball
