#pragma once

#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "models/diagram_types.h"
#include "models/language/expression.h"

namespace flyball {

struct Subsystem;

/// One entry of [blocks].
struct Member {
  const TomlEntry* entry = nullptr;  // with overrides
  Subsystem* subsystem = nullptr;    // nullptr for a block of the catalogue
  bool refused = false;              // its type was refused, which is reported
};

/// One use of a definition: the model itself, or a block that is a subsystem.
struct Subsystem {
  Subsystem(const SubsystemType& of, Report where) : type(of), report(where) {}

  const SubsystemType& type;
  Report report;
  const Subsystem* user = nullptr;   // whose block it is; nullptr of the model itself
  const TomlEntry* entry = nullptr;  // in `user`
  std::string prefix;                // of the names of its parts: "", "motor."
  std::vector<Member> members;       // in the order of the file
  NameIndex parameters;              // number in ModelParameters
  Scope scope;                       // what its expressions see
  NameIndex blocks;                  // number in ModelBlocks
  int outside = -1, inside = -1;     // numbers in ModelBlocks of its ports
  std::vector<int> fallback;  // of each slot of the ports: the Constant that stands in for a wire, or -1

  /// How its own file calls a part.
  std::string local(const std::string& name) const {
    return name.starts_with(prefix) ? name.substr(prefix.size()) : name;
  }
  /// Number of a parameter that its expressions see; -1 when there is none.
  int find_parameter(std::string_view name) const;
  const TomlValue* section(std::string_view name) const { return find_table(*type.body, name); }
};

/// The tree of subsystems of a model.
class Hierarchy {
 public:
  /// Reports overrides of blocks that do not exist.
  Hierarchy(const SubsystemType& model, const std::vector<Override>& overrides, Diagnostics& diagnostics);

  Subsystem& root() const { return *all_.front(); }
  /// Each before its parts, parts in the order of their files.
  const std::vector<std::unique_ptr<Subsystem>>& all() const { return all_; }

 private:
  Subsystem& add(const SubsystemType& type, int source);
  void unfold(Subsystem& subsystem);
  Subsystem& add_member(Subsystem& user, const SubsystemType& type, const TomlEntry& entry);
  const TomlEntry* overridden(const std::string& path, const TomlEntry& entry);
  /// Whether its block exists.
  void check_override(int number) const;

  const std::vector<Override>& overrides_;
  Diagnostics& diagnostics_;
  NameMap<std::vector<int>> of_block_;  // overrides by the path of their block
  std::deque<TomlEntry> changed_;
  std::vector<std::unique_ptr<Subsystem>> all_;
};

}  // namespace flyball
