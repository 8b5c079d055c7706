#include "models/diagram_log.h"

#include <algorithm>
#include <unordered_set>

#include "models/diagram_ports.h"
#include "models/language/messages.h"

namespace flyball {
namespace {

class LogReader {
 public:
  LogReader(const ModelBlocks& blocks, Report& report)
      : blocks_(blocks), report_(report), names_(blocks, report) {}

  void read(const TomlValue& log) {
    if (!report_.expect(log, TomlValue::Kind::list, "a list of signals such as [\"plant.y\"]")) return;
    for (const TomlValue& signal : log.items) {
      if (report_.expect(signal, TomlValue::Kind::string, "a signal such as \"plant.y\""))
        read_signal(signal);
    }
  }

  /// All numeric outputs of a block. The only one goes by the block's name.
  int add_outputs(int instance) {
    const Specification& spec = blocks_.form(instance)->specification();
    const auto numeric_output = [&](const PortSpec& port) {
      return !port.is_input && spec.slots[port.slots[0]].numeric();
    };
    const auto ports = std::ranges::count_if(spec.ports, numeric_output);
    int added = 0;
    for (const PortSpec& port : spec.ports) {
      if (!numeric_output(port)) continue;
      const bool alone = ports == 1 && port.elements.empty();
      added += add({instance, &port, -1, {}}, alone ? blocks_.instances()[instance].name : "");
    }
    return added;
  }

  std::vector<Logged> take() { return std::move(logged_); }

 private:
  void read_signal(const TomlValue& signal) {
    const Piece piece = Piece{&signal, 0, signal.text}.trimmed();
    const int instance = names_.block(piece);
    if (instance < 0 || blocks_.form(instance) == nullptr) return;
    if (piece.text.find('.') == std::string_view::npos) {
      const std::string& name = blocks_.instances()[instance].name;
      if (add_outputs(instance) == 0)
        report_.error_inside(signal, piece.offset, message::nothing_to_log(name));
      return;
    }
    const auto port = names_.port(piece, false);
    if (!port) return;
    if (blocks_.form(instance)->specification().slots[port->slot(0)].numeric()) {
      add(*port, "");
    } else {
      report_.error_inside(signal, piece.offset, message::logged_object(names_.name(*port, -1)));
    }
  }

  /// Without a name, each element goes by its full one. A signal that is named twice is one column.
  int add(const Port& port, std::string name) {
    for (int k = 0; k < port.width(); ++k) {
      Logged entry;
      entry.name = name.empty() ? names_.name(port, k) : name;
      entry.unit = blocks_.form(port.instance)->specification().slots[port.slot(k)].unit;
      entry.source = {port.instance, port.slot(k)};
      if (taken_.insert(entry.name).second) logged_.push_back(std::move(entry));
    }
    return port.width();
  }

  const ModelBlocks& blocks_;
  Report& report_;
  PortNames names_;
  std::vector<Logged> logged_;
  std::unordered_set<std::string> taken_;
};

}  // namespace

std::vector<Logged> read_log(const TomlValue* log, const ModelBlocks& blocks, Report& report) {
  LogReader reader(blocks, report);
  if (log != nullptr) {
    reader.read(*log);
    return reader.take();
  }
  const int count = static_cast<int>(blocks.instances().size());
  std::vector<bool> feeds(count);
  for (const Instance& instance : blocks.instances()) {
    for (const auto& [slot, source] : instance.inputs) {
      if (source.connected()) feeds[source.instance] = true;
    }
  }
  int added = 0;
  for (int i = 0; i < count; ++i) {
    if (!feeds[i] && blocks.form(i) != nullptr) added += reader.add_outputs(i);
  }
  if (added > 0) return reader.take();
  for (int i = 0; i < count; ++i) {
    if (blocks.form(i) != nullptr) reader.add_outputs(i);
  }
  return reader.take();
}

}  // namespace flyball
