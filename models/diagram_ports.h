#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "models/diagram_blocks.h"

namespace flyball {

/// A piece of a string in the model file, for errors inside it.
struct Piece {
  const TomlValue* string = nullptr;
  std::size_t offset = 0;
  std::string_view text;

  Piece trimmed() const;
  /// The parts between the separators, without spaces around them.
  std::vector<Piece> split(std::string_view separator) const;
};

/// A port of a block, or one element of it.
struct Port {
  int instance = -1;
  const PortSpec* spec = nullptr;
  int element = -1;  // -1: all of it
  Piece written;

  int width() const { return element >= 0 ? 1 : static_cast<int>(spec->slots.size()); }
  int slot(int k) const { return spec->slots[element >= 0 ? element : k]; }
};

/// Finds what "block", "block.port" and "block.port.element" stand for in one subsystem, and "port" and
/// "port.element" for its own ports.
class PortNames {
 public:
  PortNames(const ModelBlocks& blocks, const Subsystem& subsystem)
      : blocks_(blocks), subsystem_(subsystem), report_(subsystem.report) {}

  /// The block that a piece names; -1 when there is none, which is reported.
  int block(const Piece& piece) const;
  /// -1 when there is none.
  int find(std::string_view block) const;
  /// The port; without its name the only one, or the only input that must be connected. Nothing when there is
  /// none (which is reported), and when the block could not be constructed.
  std::optional<Port> port(const Piece& piece, bool is_input) const;
  const Report& report() const { return report_; }
  /// A port of the subsystem itself, whatever its direction; nothing when the piece names none.
  std::optional<Port> own_port(const Piece& piece) const;

 private:
  std::optional<Port> element(const Piece& piece, std::size_t start, Port port) const;
  const PortSpec* only_port(const Piece& piece, int instance, bool is_input) const;
  const PortSpec* named_port(const Piece& piece, int instance, std::string_view name, bool is_input) const;
  std::vector<std::string> names() const;

  const ModelBlocks& blocks_;
  const Subsystem& subsystem_;
  const Report& report_;
};

/// "block.port" as its own file calls it, with ".element" for element `k` of a vector.
std::string name_of(const ModelBlocks& blocks, const Port& port, int k);

}  // namespace flyball
