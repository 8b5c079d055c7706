#pragma once

#include <deque>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "models/diagram.h"
#include "models/diagram_form.h"
#include "models/diagram_hierarchy.h"
#include "models/diagram_settings.h"

namespace flyball {

/// What a named end of wires is.
enum class Role {
  block,     // of the catalogue
  outside,   // ports of a subsystem, seen by its user
  inside,    // the same, seen by its parts
  fallback,  // the Constant that an open input of a subsystem stands for
};

/// A block, or the ports of a subsystem. Only blocks become part of the diagram.
struct Node {
  Role role = Role::block;
  const Subsystem* owner = nullptr;     // whose wires reach it
  const Subsystem* ports_of = nullptr;  // of ports and fallbacks
  const BlockForm* form = nullptr;      // nullptr when it could not be constructed
};

/// [blocks] of all subsystems: constructs each block and binds its parameters.
class ModelBlocks {
 public:
  ModelBlocks(ModelParameters& parameters, const Hierarchy& hierarchy)
      : parameters_(parameters), hierarchy_(hierarchy) {}

  void read();

  const Node& node(int instance) const { return nodes_[instance]; }
  const BlockForm* form(int instance) const { return nodes_[instance].form; }
  const Hierarchy& hierarchy() const { return hierarchy_; }
  const std::vector<Instance>& instances() const { return instances_; }
  std::vector<Instance>& instances() { return instances_; }
  std::vector<DataFile> data_files() const { return files_.opened(); }
  int size() const { return static_cast<int>(instances_.size()); }
  /// How the file that a block stands in calls it.
  std::string name(int instance) const { return nodes_[instance].owner->local(instances_[instance].name); }

 private:
  /// The forms of one type that were made so far, by the text of their structure.
  struct Made {
    TableSettings::Uses uses;
    NameMap<std::unique_ptr<BlockForm>> forms;
  };

  void read(Subsystem& subsystem);
  int add(const Subsystem& owner, const TomlEntry& entry, Role role);
  void add_block(Subsystem& owner, const Member& member);
  void add_subsystem(Subsystem& owner, const Member& member);
  int add_ports(const Subsystem& owner, Subsystem& subsystem, Role role);
  void add_fallbacks(Subsystem& subsystem);
  void add_fallback(Subsystem& subsystem, const Interface::Default& given, int slot);
  void construct(int instance, const TomlEntry& entry);
  const BlockType* type_of(const Subsystem& owner, const TomlEntry& entry) const;
  const BlockForm* make(const BlockType& type, const TomlEntry& entry, const Expressions& expressions);
  void check_settings(const BlockForm& form, const TomlEntry& entry, const Report& report) const;

  ModelParameters& parameters_;
  const Hierarchy& hierarchy_;
  DataFiles files_;
  std::map<const BlockType*, Made> made_;
  // Of blocks with mistakes: not shared, kept for their ports.
  std::vector<std::unique_ptr<BlockForm>> refused_;
  std::deque<TomlEntry> fallbacks_;
  std::vector<Instance> instances_;
  std::vector<Node> nodes_;
};

}  // namespace flyball
