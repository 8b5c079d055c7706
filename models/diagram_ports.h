#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "models/diagram_blocks.h"
#include "models/diagram_report.h"

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

/// Finds what "block", "block.port" and "block.port.element" stand for.
class PortNames {
 public:
  PortNames(const ModelBlocks& blocks, Report& report) : blocks_(blocks), report_(report) {}

  /// The block that a piece names; -1 when there is none, which is reported.
  int block(const Piece& piece);
  /// The port; without its name the only one, or the only input that must be connected. Nothing when there is
  /// none (which is reported), and when the block could not be constructed.
  std::optional<Port> port(const Piece& piece, bool is_input);
  /// "block.port", with ".element" for one element of a port.
  std::string name(const Port& port, int k) const;

 private:
  const PortSpec* only_port(const Piece& piece, int instance, bool is_input);
  const PortSpec* named_port(const Piece& piece, int instance, std::string_view name, bool is_input);
  bool select_element(const Piece& piece, std::string_view name, Port& port);

  const ModelBlocks& blocks_;
  Report& report_;
};

}  // namespace flyball
