#include "studies/fit/simulation_settings.h"

#include <fmt/format.h>

#include <stdexcept>

#include "models/language/messages.h"

namespace flyball {

bool set_simulation(SimulationSettings& settings, std::string_view name, double value) {
  constexpr std::string_view section = "simulation.";
  if (!name.starts_with(section)) return false;
  if (!(value > 0.0)) throw std::invalid_argument(message::out_of_range(name, value, positive, "any"));
  const std::string_view key = name.substr(section.size());
  if (key == "stop") {
    settings.stop = value;
  } else if (key == "rtol") {
    settings.rtol = value;
  } else if (key == "atol") {
    settings.atol = value;
  } else if (key == "step") {
    settings.step = value;
  } else if (key == "max_step") {
    settings.max_step = value;
  } else {
    throw std::invalid_argument(fmt::format("{} takes no number", name));
  }
  return true;
}

}  // namespace flyball
