#include "models/diagram_ports.h"

#include <fmt/format.h>

#include <algorithm>

#include "models/language/messages.h"

namespace flyball {
namespace {

std::vector<std::string> port_names(const Specification& spec, bool is_input) {
  std::vector<std::string> names;
  for (const PortSpec& port : spec.ports) {
    if (port.is_input == is_input) names.push_back(port.name);
  }
  return names;
}

}  // namespace

Piece Piece::trimmed() const {
  constexpr std::string_view space = " \t\r\n";
  Piece result = *this;
  const std::size_t first = std::min(text.find_first_not_of(space), text.size());
  result.offset += first;
  result.text.remove_prefix(first);
  result.text = result.text.substr(0, result.text.find_last_not_of(space) + 1);
  return result;
}

std::vector<Piece> Piece::split(std::string_view separator) const {
  std::vector<Piece> result;
  std::size_t start = 0;
  while (true) {
    const std::size_t end = std::min(text.find(separator, start), text.size());
    result.push_back(Piece{string, offset + start, text.substr(start, end - start)}.trimmed());
    if (end == text.size()) return result;
    start = end + separator.size();
  }
}

int PortNames::find(std::string_view block) const {
  const auto found = subsystem_.blocks.find(block);
  return found == subsystem_.blocks.end() ? -1 : found->second;
}

std::vector<std::string> PortNames::names() const {
  std::vector<std::string> result;
  for (const Member& member : subsystem_.members) result.push_back(member.entry->key);
  for (const PortSpec& port : blocks_.form(subsystem_.inside)->specification().ports)
    result.push_back(port.name);
  return result;
}

int PortNames::block(const Piece& piece) const {
  const std::string_view name = piece.text.substr(0, piece.text.find('.'));
  const int found = find(name);
  if (found >= 0) return found;
  // Where hundreds of names are wrong, a search among all blocks for each would take minutes.
  constexpr int enough = 100;
  const auto candidates = report_.errors() < enough ? names() : std::vector<std::string>{};
  report_.error_inside(*piece.string, piece.offset,
                       name.empty() ? message::expected_block() : message::unknown_block(name, candidates));
  return -1;
}

std::optional<Port> PortNames::own_port(const Piece& piece) const {
  const std::size_t dot = piece.text.find('.');
  Port result;
  result.instance = subsystem_.inside;
  result.spec = blocks_.form(subsystem_.inside)->specification().port(piece.text.substr(0, dot));
  result.written = piece;
  if (result.spec == nullptr) return std::nullopt;
  return dot == std::string_view::npos ? std::optional(result) : element(piece, dot + 1, result);
}

std::optional<Port> PortNames::port(const Piece& piece, bool is_input) const {
  const std::size_t dot = piece.text.find('.');
  const std::string_view first = piece.text.substr(0, dot);
  if (const PortSpec* own = blocks_.form(subsystem_.inside)->specification().port(first)) {
    if (own->is_input == is_input) return own_port(piece);
    // Seen from inside, an input of the subsystem is a source.
    report_.error_inside(*piece.string, piece.offset, message::port_direction(first, !own->is_input));
    return std::nullopt;
  }
  Port result;
  result.instance = block(piece);
  result.written = piece;
  if (result.instance < 0 || blocks_.form(result.instance) == nullptr) return std::nullopt;
  if (dot == std::string_view::npos) {
    result.spec = only_port(piece, result.instance, is_input);
    return result.spec == nullptr ? std::nullopt : std::optional(result);
  }
  const std::string_view rest = piece.text.substr(dot + 1);
  const std::size_t second = rest.find('.');
  const std::string_view name = rest.substr(0, second);
  result.spec = named_port({piece.string, piece.offset + dot + 1, rest}, result.instance, name, is_input);
  if (result.spec == nullptr) return std::nullopt;
  return second == std::string_view::npos ? std::optional(result) : element(piece, dot + second + 2, result);
}

/// The element that the rest of a piece names.
std::optional<Port> PortNames::element(const Piece& piece, std::size_t start, Port port) const {
  const std::string_view name = piece.text.substr(start);
  const auto& elements = port.spec->elements;
  const auto found = std::ranges::find(elements, name);
  port.element = static_cast<int>(found - elements.begin());
  if (found != elements.end()) return port;
  const Port whole{port.instance, port.spec, -1, port.written};
  report_.error_inside(*piece.string, piece.offset + start,
                       message::unknown_element(name_of(blocks_, whole, -1), name, elements));
  return std::nullopt;
}

const PortSpec* PortNames::only_port(const Piece& piece, int instance, bool is_input) const {
  const Specification& spec = blocks_.form(instance)->specification();
  const PortSpec* first = nullptr;
  const PortSpec* required = nullptr;
  int ports = 0;
  int needed = 0;
  for (const PortSpec& port : spec.ports) {
    if (port.is_input != is_input) continue;
    if (ports++ == 0) first = &port;
    if (is_input && spec.slots[port.slots[0]].optional) continue;
    if (needed++ == 0) required = &port;
  }
  if (ports == 1) return first;
  if (is_input && needed == 1) return required;
  const std::string name = blocks_.name(instance);
  const std::string& type = blocks_.form(instance)->object->type->name;
  report_.error_inside(*piece.string, piece.offset,
                       ports == 0 ? message::no_port(name, type, is_input)
                                  : message::several_ports(name, type, is_input, port_names(spec, is_input)));
  return nullptr;
}

const PortSpec* PortNames::named_port(const Piece& piece, int instance, std::string_view name,
                                      bool is_input) const {
  const Specification& spec = blocks_.form(instance)->specification();
  const auto found = std::ranges::find_if(
      spec.ports, [&](const PortSpec& port) { return port.is_input == is_input && port.name == name; });
  if (found != spec.ports.end()) return &*found;
  const std::string block = blocks_.name(instance);
  const auto candidates = port_names(spec, is_input);
  report_.error_inside(*piece.string, piece.offset,
                       spec.port(name) != nullptr
                           ? message::wrong_direction(block, name, is_input, candidates)
                           : message::unknown_port(block, name, is_input, candidates));
  return nullptr;
}

std::string name_of(const ModelBlocks& blocks, const Port& port, int k) {
  std::string name = port.spec->name;
  // Ports of a subsystem go by their names alone, inside.
  if (blocks.node(port.instance).role != Role::inside)
    name = fmt::format("{}.{}", blocks.name(port.instance), name);
  const int element = port.element >= 0 ? port.element : k;
  if (port.spec->elements.empty() || element < 0) return name;
  return fmt::format("{}.{}", name, port.spec->elements[element]);
}

}  // namespace flyball
