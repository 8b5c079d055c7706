#pragma once

#include <optional>
#include <vector>

#include "models/diagram_blocks.h"
#include "models/diagram_ports.h"
#include "models/diagram_report.h"

namespace flyball {

/// The wires of [diagram]: connects the inputs of the blocks.
class ModelWires {
 public:
  ModelWires(ModelBlocks& blocks, Report& report);

  void read(const TomlValue& list);
  /// Reports the inputs that no wire drives.
  void check_missing();

 private:
  /// What drives an input.
  struct Driver {
    Piece end;            // of the wire that came first
    bool broken = false;  // a wire that was refused: the input is not missing
  };

  void read_wire(const TomlValue& wire);
  /// Without a source the input counts as driven: its wire was refused.
  void connect(const std::optional<Port>& source, const Piece& to);
  void connect(const Port& from, const Port& to);
  bool compatible(const Port& from, const Port& to);
  bool equal_units(const Port& from, const Port& to);
  const SlotSpec& slot(const Port& port, int k) const;
  Driver& driver(int instance, int slot);
  void set_broken(const Port& port);
  void check_missing(int instance, const PortSpec& port);

  ModelBlocks& blocks_;
  Report& report_;
  PortNames names_;
  std::vector<std::size_t> first_driver_;  // of each instance
  std::vector<Driver> drivers_;            // of each input
  std::vector<bool> silent_;               // instances whose wires name a wrong port
};

}  // namespace flyball
