#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "models/diagram_blocks.h"
#include "models/diagram_ports.h"

namespace flyball {

/// No wire is longer, in bytes: telling where each mistake in it stands takes time that grows with its
/// square.
inline constexpr std::size_t longest_wire = 100'000;

/// The wires of [diagram] of all subsystems: connects the inputs of the blocks, and ports of subsystems.
class ModelWires {
 public:
  explicit ModelWires(ModelBlocks& blocks);

  /// Reports also the inputs that no wire drives.
  void read();

 private:
  /// What drives an input.
  struct Driver {
    Piece end;            // of the wire that came first
    bool broken = false;  // a wire that was refused: the input is not missing
  };

  void read(const Subsystem& subsystem);
  void read_wire(const PortNames& names, const TomlValue& wire);
  /// Without a source the input counts as driven: its wire was refused.
  void connect(const PortNames& names, const std::optional<Port>& source, const Piece& to);
  void connect(const Port& from, const Port& to);
  bool compatible(const Port& from, const Port& to) const;
  bool equal_units(const Port& from, const Port& to) const;
  const SlotSpec& slot(const Port& port, int k) const;
  Driver& driver(int instance, int slot);
  void set_broken(const Port& port);
  void check_missing(int instance, const PortSpec& port);
  void check_missing_of_model() const;
  std::pair<Position, std::string> declaration(const Port& port) const;
  const Report& report(const Port& port) const { return blocks_.node(port.instance).owner->report; }
  std::string name(const Port& port, int k) const { return name_of(blocks_, port, k); }

  ModelBlocks& blocks_;
  std::vector<std::size_t> first_driver_;  // of each instance
  std::vector<Driver> drivers_;            // of each input
  std::vector<bool> silent_;               // instances whose wires name a wrong port
};

}  // namespace flyball
