#include "models/diagram_wires.h"

#include <algorithm>

#include "models/language/messages.h"
#include "models/language/units.h"

namespace flyball {

ModelWires::ModelWires(ModelBlocks& blocks) : blocks_(blocks), silent_(blocks.instances().size()) {
  std::size_t count = 0;
  for (const Instance& instance : blocks.instances()) {
    first_driver_.push_back(count);
    count += instance.inputs.size();
  }
  drivers_.resize(count);
}

void ModelWires::read() {
  for (const auto& subsystem : blocks_.hierarchy().all()) read(*subsystem);
  for (int i = 0; i < blocks_.size(); ++i) {
    if (blocks_.form(i) == nullptr || silent_[i]) continue;
    for (const PortSpec& port : blocks_.form(i)->specification().ports) {
      if (port.is_input) check_missing(i, port);
    }
  }
  check_missing_of_model();
}

void ModelWires::read(const Subsystem& subsystem) {
  const TomlValue* diagram = subsystem.section("diagram");
  const TomlValue* wires = diagram == nullptr ? nullptr : diagram->find("wires");
  const Report& report = subsystem.report;
  if (wires == nullptr) return;
  if (!report.expect(*wires, TomlValue::Kind::list, "a list of wires such as [\"a -> b\"]")) return;
  const PortNames names(blocks_, subsystem);
  for (const TomlValue& wire : wires->items) {
    if (report.expect(wire, TomlValue::Kind::string, "a wire such as \"a -> b\"")) read_wire(names, wire);
  }
}

void ModelWires::read_wire(const PortNames& names, const TomlValue& wire) {
  const Report& report = names.report();
  if (wire.text.size() > longest_wire) return report.error(wire.at, message::wire_too_long(longest_wire));
  const auto links = Piece{&wire, 0, wire.text}.split("->");
  if (links.size() < 2) return report.error_inside(wire, 0, message::wire_without_arrow());
  for (std::size_t k = 0; k + 1 < links.size(); ++k) {
    if (const std::size_t comma = links[k].text.find(','); comma != std::string_view::npos) {
      return report.error_inside(wire, links[k].offset + comma, message::fan_out_inside_chain());
    }
  }
  for (std::size_t k = 0; k + 1 < links.size(); ++k) {
    // A block inside a chain was reached by its input; it goes on from its only output.
    Piece from = links[k];
    if (k > 0) from.text = from.text.substr(0, from.text.find('.'));
    const bool reported = k > 0 && names.find(from.text) < 0 && !names.own_port(from);
    const auto source = reported ? std::nullopt : names.port(from, false);
    for (const Piece& to : links[k + 1].split(",")) connect(names, source, to);
  }
}

void ModelWires::connect(const PortNames& names, const std::optional<Port>& source, const Piece& to) {
  const auto target = names.port(to, true);
  if (source && target) return connect(*source, *target);
  if (target) return set_broken(*target);
  const int instance = names.find(to.text.substr(0, to.text.find('.')));
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
      report(to).error_inside(*to.written.string, to.written.offset, message::driven_twice(name(to, k)));
      return report(to).note(report(to).inside(*before.end.string, before.end.offset),
                             message::first_wire_here());
    }
    before.end = to.written;
    const int rank = blocks_.form(to.instance)->input_rank[to.slot(k)];
    target.inputs[rank].second = {from.instance, from.slot(k)};
  }
}

bool ModelWires::compatible(const Port& from, const Port& to) const {
  const SlotSpec& source = slot(from, 0);
  const SlotSpec& target = slot(to, 0);
  std::string wrong;
  if (source.numeric() != target.numeric()) {
    wrong = message::object_and_number(name(from, -1), name(to, -1), target.numeric());
  } else if (!source.numeric() && source.type != target.type) {
    wrong = message::different_objects(name(from, -1), name(to, -1));
  } else if (from.width() != to.width()) {
    wrong = message::different_widths(name(from, -1), from.width(), name(to, -1), to.width());
  } else {
    return !source.numeric() || equal_units(from, to);
  }
  report(to).error_inside(*to.written.string, to.written.offset, std::move(wrong));
  const auto [at, block] = declaration(from);
  report(to).note(at, message::declared_here(block));
  return false;
}

bool ModelWires::equal_units(const Port& from, const Port& to) const {
  for (int k = 0; k < from.width(); ++k) {
    const std::string& source = slot(from, k).unit;
    const std::string& target = slot(to, k).unit;
    if (source == target || source == "any" || target == "any") continue;
    if (declared_dimension(source) == declared_dimension(target)) continue;
    report(to).error_inside(*to.written.string, to.written.offset,
                            message::different_units(name(from, k), source, name(to, k), target));
    const auto [at, block] = declaration(from);
    const bool own = blocks_.node(from.instance).role == Role::inside;
    report(to).note(at, own ? message::declared_here(block)
                            : message::block_of_type(block, blocks_.form(from.instance)->object->type->name));
    return false;
  }
  return true;
}

/// Where the end of a wire was declared, and under which name.
std::pair<Position, std::string> ModelWires::declaration(const Port& port) const {
  const Node& node = blocks_.node(port.instance);
  if (node.role != Role::inside) return {blocks_.instances()[port.instance].at, blocks_.name(port.instance)};
  return {node.owner->report.here(node.owner->type.interface.position(port.spec->name)), port.spec->name};
}

void ModelWires::check_missing(int instance, const PortSpec& port) {
  const auto open = [&](int slot) {
    const Driver& found = driver(instance, slot);
    return found.end.string == nullptr && !found.broken &&
           !blocks_.form(instance)->specification().slots[slot].optional;
  };
  const auto& slots = blocks_.form(instance)->specification().slots;
  const bool inside = blocks_.node(instance).role == Role::inside;
  // One error for a port of which no element is driven, else one for each element.
  const bool whole = std::ranges::all_of(port.slots, open);
  for (std::size_t k = 0; k < port.slots.size(); ++k) {
    if (!open(port.slots[k])) continue;
    const Port end{instance, &port, whole ? -1 : static_cast<int>(k), {}};
    const std::string missing = name(end, -1);
    report(end).error(declaration(end).first,
                      inside ? message::output_not_driven(missing)
                             : message::not_connected(missing, slots[port.slots[k]].unit, port.doc));
    if (whole) return;
  }
}

/// A file with ports that is run alone has nobody who connects its inputs.
void ModelWires::check_missing_of_model() const {
  const Subsystem& model = blocks_.hierarchy().root();
  for (const PortSpec& port : blocks_.form(model.inside)->specification().ports) {
    if (port.is_input || model.fallback[port.slots[0]] >= 0) continue;
    model.report.error(model.type.interface.position(port.name), message::input_of_model_open(port.name));
  }
}

}  // namespace flyball
