#include "models/diagram_guesses.h"

#include "models/language/messages.h"

namespace flyball {
namespace {

constexpr const char* a_guess = "a guess such as { port = \"plant.y\", value = 1.0 }";

}  // namespace

std::vector<Guess> read_guesses(const TomlValue& guesses, const ModelBlocks& blocks,
                                const Expressions& expressions) {
  std::vector<Guess> result;
  const Report& report = expressions.subsystem().report;
  if (!report.expect(guesses, TomlValue::Kind::list, "a list of guesses")) return result;
  const PortNames names(blocks, expressions.subsystem());
  for (const TomlValue& guess : guesses.items) {
    if (!report.expect(guess, TomlValue::Kind::table, a_guess)) continue;
    report.check_keys(guess, "a guess", {"port", "value"});
    const TomlValue *where = guess.find("port"), *value = guess.find("value");
    if (where == nullptr || value == nullptr) {
      report.error(guess, message::missing_key(where == nullptr ? "port" : "value", "a guess"));
      continue;
    }
    if (!report.expect(*where, TomlValue::Kind::string, "a port such as \"plant.y\"")) continue;
    const auto port = names.port(Piece{where, 0, where->text}.trimmed(), false);
    if (!port) continue;
    const SlotSpec& slot = blocks.form(port->instance)->specification().slots[port->slot(0)];
    if (port->width() != 1 || !slot.numeric()) {
      report.error_inside(*where, 0, message::not_one_number(name_of(blocks, *port, -1)));
      continue;
    }
    if (const auto number = expressions.fixed(*value, slot.unit)) {
      result.push_back({{port->instance, port->slot(0)}, *number, report.here(where->at)});
    }
  }
  return result;
}

}  // namespace flyball
