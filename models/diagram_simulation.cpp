#include "models/diagram_simulation.h"

#include <algorithm>

#include "models/language/messages.h"

namespace flyball {
namespace {

const std::vector<std::string>& methods() {
  static const std::vector<std::string> names{"auto",  "dp5",      "rk4",   "heun", "euler",
                                              "exact", "discrete", "adams", "bdf"};
  return names;
}

class SimulationReader {
 public:
  SimulationReader(const std::vector<std::string>& states, ModelParameters& parameters, Report& report)
      : states_(states), parameters_(parameters), report_(report) {}

  SimulationSettings read(const TomlValue& section) {
    report_.check_keys(section, "[simulation]",
                       {"stop", "solver", "log_interval", "algebraic_loops", "seed"});
    settings_.stop = above_zero(section, "stop", "s").value_or(settings_.stop);
    if (const TomlValue* seed = section.find("seed")) read_seed(*seed);
    if (const TomlValue* solver = section.find("solver")) read_solver(*solver);
    if (above_zero(section, "log_interval", "s")) {
      settings_.log_interval = parameters_.exact(*section.find("log_interval"), "s");
    }
    if (const TomlValue* loops = section.find("algebraic_loops")) read_loops(*loops);
    return settings_;
  }

 private:
  void read_loops(const TomlValue& loops) {
    if (!report_.expect(loops, TomlValue::Kind::string, "\"solve\" or \"refuse\"")) return;
    settings_.refuse_loops = loops.text == "refuse";
    if (loops.text == "solve" || settings_.refuse_loops) return;
    report_.error_inside(loops, 0,
                         message::unknown_choice("algebraic_loops", loops.text, {"solve", "refuse"}));
  }

  void read_seed(const TomlValue& seed) {
    if (!report_.expect(seed, TomlValue::Kind::integer, "a whole number")) return;
    if (seed.integer < 0)
      return report_.error(seed, message::out_of_range("seed", seed.number, non_negative, "1"));
    settings_.seed = static_cast<std::uint64_t>(seed.integer);
  }

  void read_solver(const TomlValue& solver) {
    if (!report_.expect(solver, TomlValue::Kind::table, "a table such as { method = \"dp5\" }")) return;
    report_.check_keys(solver, "solver", {"method", "rtol", "atol", "max_step", "step"});
    if (const TomlValue* method = solver.find("method")) read_method(*method);
    settings_.rtol = above_zero(solver, "rtol", "1").value_or(settings_.rtol);
    settings_.atol = above_zero(solver, "atol", "1").value_or(settings_.atol);
    settings_.max_step = above_zero(solver, "max_step", "s");
    settings_.step = above_zero(solver, "step", "s");
  }

  void read_method(const TomlValue& method) {
    if (!report_.expect(method, TomlValue::Kind::string, "the name of a method in quotes")) return;
    settings_.method = method.text;
    if (std::ranges::find(methods(), method.text) == methods().end()) {
      report_.error_inside(method, 0, message::unknown_method(method.text, methods()));
    } else if (method.text == "discrete" && !states_.empty()) {
      report_.error_inside(method, 0, message::discrete_with_states(states_));
    }
  }

  std::optional<double> above_zero(const TomlValue& table, std::string_view key, const std::string& unit) {
    const TomlValue* value = table.find(key);
    const auto number = value == nullptr ? std::nullopt : parameters_.fixed(*value, unit);
    if (!number || *number > 0.0) return number;
    report_.error(*value, message::out_of_range(key, *number, positive, unit));
    return std::nullopt;
  }

  const std::vector<std::string>& states_;
  ModelParameters& parameters_;
  Report& report_;
  SimulationSettings settings_;
};

}  // namespace

SimulationSettings read_simulation(const TomlValue& section, const std::vector<std::string>& states,
                                   ModelParameters& parameters, Report& report) {
  return SimulationReader(states, parameters, report).read(section);
}

}  // namespace flyball
