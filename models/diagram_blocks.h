#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "models/diagram.h"
#include "models/diagram_parameters.h"
#include "models/diagram_report.h"
#include "models/diagram_settings.h"

namespace flyball {

/// A block object, with what instances of it have in common.
struct BlockForm {
  std::shared_ptr<const BlockObject> object;
  std::vector<int> params;      // slots
  std::vector<int> inputs;      // slots, of numbers and objects
  std::vector<int> input_rank;  // of a slot: its place in `inputs`, or -1

  const Specification& specification() const { return *object->specification; }
};

/// [blocks]: constructs each block and binds its parameters.
class ModelBlocks {
 public:
  ModelBlocks(ModelParameters& parameters, Report& report) : parameters_(parameters), report_(report) {}

  void read(const TomlValue& section);

  /// -1 when there is none. A block that could not be constructed counts as one.
  int find(std::string_view name) const;
  /// nullptr for a block that could not be constructed.
  const BlockForm* form(int instance) const { return forms_[instance]; }
  const std::vector<Instance>& instances() const { return instances_; }
  std::vector<Instance>& instances() { return instances_; }
  std::vector<DataFile> data_files() const { return files_.opened(); }
  std::vector<std::string> names() const;

 private:
  /// The forms of one type that were made so far, by the text of their structure.
  struct Made {
    TableSettings::Uses uses;
    NameMap<std::unique_ptr<BlockForm>> forms;
  };

  const BlockType* type_of(const TomlEntry& entry);
  const BlockForm* make(const BlockType& type, const TomlEntry& entry);
  void check_settings(const BlockForm& form, const TomlEntry& entry);
  void bind(const BlockForm& form, const TomlEntry& entry, Instance& instance);
  std::optional<Binding> bind(const SlotSpec& slot, const TomlEntry& entry);
  void check_order(const BlockForm& form, const TomlEntry& entry, const Instance& instance);
  void check_range(const SlotSpec& slot, const Binding& binding, const TomlValue& value);

  ModelParameters& parameters_;
  DataFiles files_;
  Report& report_;
  std::map<const BlockType*, Made> made_;
  std::vector<std::unique_ptr<BlockForm>>
      refused_;  // of blocks with mistakes: not shared, kept for their ports
  std::vector<Instance> instances_;
  std::vector<const BlockForm*> forms_;
  NameIndex names_;
};

}  // namespace flyball
