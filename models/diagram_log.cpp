#include "models/diagram_log.h"

#include <algorithm>
#include <unordered_set>

#include "models/diagram_ports.h"
#include "models/language/messages.h"

namespace flyball {
namespace {

class LogReader {
 public:
  explicit LogReader(const ModelBlocks& blocks) : blocks_(blocks), root_(blocks.hierarchy().root()) {}

  void read(const TomlValue& log) {
    if (!root_.report.expect(log, TomlValue::Kind::list, "a list of signals such as [\"plant.y\"]")) return;
    for (const TomlValue& signal : log.items) {
      if (root_.report.expect(signal, TomlValue::Kind::string, "a signal such as \"plant.y\""))
        read_signal(signal);
    }
  }

  void add_default() {
    int added = 0;
    for (const PortSpec& port : blocks_.form(root_.inside)->specification().ports) {
      if (port.is_input) added += add({root_.inside, &port, -1, {}}, "");
    }
    if (added > 0) return;
    std::vector<bool> feeds(blocks_.size());
    for (const Instance& instance : blocks_.instances()) {
      for (const auto& [slot, source] : instance.inputs) {
        if (source.connected()) feeds[source.instance] = true;
      }
    }
    for (const bool all : {false, true}) {
      for (const Member& member : root_.members) {
        const int i = root_.blocks.find(member.entry->key)->second;
        if ((all || !feeds[i]) && blocks_.form(i) != nullptr) added += add_outputs(i);
      }
      if (added > 0) return;
    }
  }

  std::vector<Logged> take() { return std::move(logged_); }

 private:
  void read_signal(const TomlValue& signal) {
    Piece piece = Piece{&signal, 0, signal.text}.trimmed();
    const PortNames names(blocks_, within(piece));
    if (const auto own = names.own_port(piece)) {
      add(*own, "");
      return;
    }
    const int instance = names.block(piece);
    if (instance < 0 || blocks_.form(instance) == nullptr) return;
    if (piece.text.find('.') == std::string_view::npos) {
      if (add_outputs(instance) == 0)
        root_.report.error_inside(signal, piece.offset, message::nothing_to_log(blocks_.name(instance)));
      return;
    }
    const auto port = names.port(piece, false);
    if (!port) return;
    if (blocks_.form(instance)->specification().slots[port->slot(0)].numeric()) {
      add(*port, "");
    } else {
      root_.report.error_inside(signal, piece.offset, message::logged_object(name_of(blocks_, *port, -1)));
    }
  }

  /// The subsystem whose block a path names. The piece is then what is left of the path.
  const Subsystem& within(Piece& piece) const {
    const Subsystem* at = &root_;
    while (true) {
      const std::size_t dot = piece.text.find('.');
      const auto found = at->blocks.find(piece.text.substr(0, dot));
      const Subsystem* inner = found == at->blocks.end() ? nullptr : blocks_.node(found->second).ports_of;
      if (inner == nullptr || dot == std::string_view::npos) return *at;
      const std::string_view rest = piece.text.substr(dot + 1);
      if (!inner->blocks.contains(rest.substr(0, rest.find('.')))) return *at;
      at = inner;
      piece.offset += dot + 1;
      piece.text = rest;
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

  /// Without a name, each element goes by its full one. A signal that is named twice is one column.
  int add(const Port& port, std::string name) {
    const BlockForm& form = *blocks_.form(port.instance);
    for (int k = 0; k < port.width(); ++k) {
      Logged entry;
      entry.name =
          name.empty() ? blocks_.node(port.instance).owner->prefix + name_of(blocks_, port, k) : name;
      entry.unit = form.specification().slots[port.slot(k)].unit;
      entry.source = {port.instance, port.slot(k)};
      // A port of the model itself that wires end at shows what drives it.
      if (port.spec->is_input)
        entry.source = blocks_.instances()[port.instance].inputs[form.input_rank[port.slot(k)]].second;
      if (taken_.insert(entry.name).second) logged_.push_back(std::move(entry));
    }
    return port.width();
  }

  const ModelBlocks& blocks_;
  const Subsystem& root_;
  std::vector<Logged> logged_;
  std::unordered_set<std::string> taken_;
};

}  // namespace

std::vector<Logged> read_log(const TomlValue* log, const ModelBlocks& blocks) {
  LogReader reader(blocks);
  if (log != nullptr) {
    reader.read(*log);
  } else {
    reader.add_default();
  }
  return reader.take();
}

}  // namespace flyball
