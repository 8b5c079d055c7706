#include "models/diagram_wires.h"

#include <algorithm>

#include "models/language/messages.h"
#include "models/language/units.h"

namespace flyball {

ModelWires::ModelWires(ModelBlocks& blocks, Report& report)
    : blocks_(blocks), report_(report), names_(blocks, report), silent_(blocks.instances().size()) {
  std::size_t count = 0;
  for (const Instance& instance : blocks.instances()) {
    first_driver_.push_back(count);
    count += instance.inputs.size();
  }
  drivers_.resize(count);
}

void ModelWires::read(const TomlValue& list) {
  if (!report_.expect(list, TomlValue::Kind::list, "a list of wires such as [\"a -> b\"]")) return;
  for (const TomlValue& wire : list.items) {
    if (report_.expect(wire, TomlValue::Kind::string, "a wire such as \"a -> b\"")) read_wire(wire);
  }
}

void ModelWires::read_wire(const TomlValue& wire) {
  const auto links = Piece{&wire, 0, wire.text}.split("->");
  if (links.size() < 2) return report_.error_inside(wire, 0, message::wire_without_arrow());
  for (std::size_t k = 0; k + 1 < links.size(); ++k) {
    if (const std::size_t comma = links[k].text.find(','); comma != std::string_view::npos) {
      return report_.error_inside(wire, links[k].offset + comma, message::fan_out_inside_chain());
    }
  }
  for (std::size_t k = 0; k + 1 < links.size(); ++k) {
    // A block inside a chain was reached by its input; it goes on from its only output.
    Piece from = links[k];
    if (k > 0) from.text = from.text.substr(0, from.text.find('.'));
    const bool reported = k > 0 && blocks_.find(from.text) < 0;
    const auto source = reported ? std::nullopt : names_.port(from, false);
    for (const Piece& to : links[k + 1].split(",")) connect(source, to);
  }
}

void ModelWires::connect(const std::optional<Port>& source, const Piece& to) {
  const auto target = names_.port(to, true);
  if (source && target) return connect(*source, *target);
  if (target) return set_broken(*target);
  const int instance = blocks_.find(to.text.substr(0, to.text.find('.')));
  if (instance >= 0) silent_[instance] = true;
}

ModelWires::Driver& ModelWires::driver(int instance, int slot) {
  return drivers_[first_driver_[instance] + blocks_.form(instance)->input_rank[slot]];
}

void ModelWires::set_broken(const Port& port) {
  for (int k = 0; k < port.width(); ++k) driver(port.instance, port.slot(k)).broken = true;
}

const SlotSpec& ModelWires::slot(const Port& port, int k) const {
  return blocks_.form(port.instance)->specification().slots[port.slot(k)];
}

void ModelWires::connect(const Port& from, const Port& to) {
  if (!compatible(from, to)) return set_broken(to);
  Instance& target = blocks_.instances()[to.instance];
  for (int k = 0; k < to.width(); ++k) {
    Driver& before = driver(to.instance, to.slot(k));
    if (before.end.string != nullptr) {
      report_.error_inside(*to.written.string, to.written.offset, message::driven_twice(names_.name(to, k)));
      return report_.note(report_.inside(*before.end.string, before.end.offset), message::first_wire_here());
    }
    before.end = to.written;
    const int rank = blocks_.form(to.instance)->input_rank[to.slot(k)];
    target.inputs[rank].second = {from.instance, from.slot(k)};
  }
}

bool ModelWires::compatible(const Port& from, const Port& to) {
  const SlotSpec& source = slot(from, 0);
  const SlotSpec& target = slot(to, 0);
  std::string wrong;
  if (source.numeric() != target.numeric()) {
    wrong = message::object_and_number(names_.name(from, -1), names_.name(to, -1), target.numeric());
  } else if (!source.numeric() && source.type != target.type) {
    wrong = message::different_objects(names_.name(from, -1), names_.name(to, -1));
  } else if (from.width() != to.width()) {
    wrong = message::different_widths(names_.name(from, -1), from.width(), names_.name(to, -1), to.width());
  } else {
    return !source.numeric() || equal_units(from, to);
  }
  report_.error_inside(*to.written.string, to.written.offset, std::move(wrong));
  report_.note(blocks_.instances()[from.instance].at,
               message::declared_here(blocks_.instances()[from.instance].name));
  return false;
}

bool ModelWires::equal_units(const Port& from, const Port& to) {
  for (int k = 0; k < from.width(); ++k) {
    const std::string& source = slot(from, k).unit;
    const std::string& target = slot(to, k).unit;
    if (source == target || source == "any" || target == "any") continue;
    if (declared_dimension(source) == declared_dimension(target)) continue;
    report_.error_inside(*to.written.string, to.written.offset,
                         message::different_units(names_.name(from, k), source, names_.name(to, k), target));
    const Instance& block = blocks_.instances()[from.instance];
    report_.note(block.at, message::block_of_type(block.name, block.object->type->name));
    return false;
  }
  return true;
}

void ModelWires::check_missing() {
  for (int i = 0; i < static_cast<int>(blocks_.instances().size()); ++i) {
    if (blocks_.form(i) == nullptr || silent_[i]) continue;
    for (const PortSpec& port : blocks_.form(i)->specification().ports) {
      if (port.is_input) check_missing(i, port);
    }
  }
}

void ModelWires::check_missing(int instance, const PortSpec& port) {
  const auto open = [&](int slot) {
    const Driver& found = driver(instance, slot);
    return found.end.string == nullptr && !found.broken &&
           !blocks_.form(instance)->specification().slots[slot].optional;
  };
  const Position at = blocks_.instances()[instance].at;
  const auto& slots = blocks_.form(instance)->specification().slots;
  // One error for a port of which no element is driven, else one for each element.
  const bool whole = std::ranges::all_of(port.slots, open);
  for (std::size_t k = 0; k < port.slots.size(); ++k) {
    if (!open(port.slots[k])) continue;
    const Port end{instance, &port, whole ? -1 : static_cast<int>(k), {}};
    report_.error(at, message::not_connected(names_.name(end, -1), slots[port.slots[k]].unit, port.doc));
    if (whole) return;
  }
}

}  // namespace flyball
