#include "models/diagram_blocks.h"

#include <algorithm>

#include "models/language/messages.h"

namespace flyball {
namespace {

/// The value of a parameter that is an entry of a list, or of a list of lists, counted in row-major order.
const TomlValue* entry_of(const TomlValue& list, int entry) {
  for (const TomlValue& item : list.items) {
    if (!item.is(TomlValue::Kind::list))
      return entry < static_cast<int>(list.items.size()) ? &list.items[entry] : nullptr;
    if (entry < static_cast<int>(item.items.size())) return &item.items[entry];
    entry -= static_cast<int>(item.items.size());
  }
  return nullptr;
}

/// A key of a block's table belongs to a parameter, unless nothing may set it.
bool gives(const SlotSpec& slot, std::string_view key) {
  return slot.kind == SlotKind::param && !slot.fixed && slot.reference.empty() && slot.setting == key;
}

bool has_setting(const Specification& spec, std::string_view key) {
  return key == "type" ||
         std::ranges::find(spec.structure, key, &StructureSpec::key) != spec.structure.end() ||
         std::ranges::any_of(spec.slots, [&](const SlotSpec& slot) { return gives(slot, key); });
}

std::vector<std::string> setting_names(const Specification& spec) {
  std::vector<std::string> names;
  for (const SlotSpec& slot : spec.slots) {
    if (gives(slot, slot.setting)) names.push_back(slot.setting);
  }
  for (const StructureSpec& structure : spec.structure) names.push_back(structure.key);
  std::ranges::sort(names);
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

/// Block types by name and alias, and the subsystems that a subsystem sees.
std::vector<std::string> type_names(const Subsystem& subsystem) {
  std::vector<std::string> names = block_type_names();
  for (const SubsystemType* type = &subsystem.type; type != nullptr; type = type->outer) {
    for (const auto& [name, local] : type->local) names.push_back(name);
  }
  std::ranges::sort(names);
  return names;
}

/// Binds the parameters of a block.
class Binder {
 public:
  Binder(const TomlEntry& entry, const Expressions& expressions)
      : entry_(entry), expressions_(expressions), report_(expressions.subsystem().report) {}

  void bind(const BlockForm& form, Instance& instance) const {
    const auto& slots = form.specification().slots;
    instance.parameters.reserve(form.params.size());
    for (const int s : form.params) {
      auto binding = bind(slots[s]);
      if (binding) instance.parameters.emplace_back(s, *std::move(binding));
    }
    check_order(slots, instance);
  }

 private:
  std::optional<Binding> bind(const SlotSpec& slot) const {
    Binding binding;
    binding.value = slot.fallback;
    binding.at = report_.here(entry_.at);
    if (!slot.reference.empty()) {
      binding.kind = Binding::Kind::parameter;
      binding.parameter = expressions_.find(slot.reference);
      return binding;
    }
    const TomlValue* value = slot.fixed ? nullptr : entry_.value.find(slot.setting);
    if (value == nullptr) return binding;
    if (slot.entry >= 0) {
      value = entry_of(*value, slot.entry);
      const bool refused = value == nullptr || !(value->numeric() || value->is(TomlValue::Kind::string));
      if (refused) return std::nullopt;
    }
    auto given = expressions_.bind(*value, slot.unit);
    if (given) check_range(slot, *given, *value);
    return given;
  }

  /// Entries of a list that must rise.
  void check_order(const std::vector<SlotSpec>& slots, const Instance& instance) const {
    const Binding* before = nullptr;
    int slot_before = -1;
    for (const auto& [s, binding] : instance.parameters) {
      const TomlValue* list = entry_.value.find(slots[s].setting);
      if (slots[s].exceeds >= 0 && slots[s].exceeds == slot_before && list != nullptr) {
        const double value = expressions_.value(binding), least = expressions_.value(*before);
        if (!(value > least))
          report_.error(*entry_of(*list, slots[s].entry),
                        message::not_increasing(slots[s].name, value, least));
      }
      before = &binding;
      slot_before = s;
    }
  }

  void check_range(const SlotSpec& slot, const Binding& binding, const TomlValue& value) const {
    const double number = expressions_.value(binding);
    if (slot.range.contains(number)) return;
    report_.error(value, message::out_of_range(slot.name, number, slot.range, slot.unit));
    std::vector<int> used = binding.operands;
    if (binding.kind == Binding::Kind::parameter) used.push_back(binding.parameter);
    for (const int number_of : used) {
      const ParameterEntry& parameter = expressions_.parameter(number_of);
      report_.note(parameter.at,
                   message::declared_here(expressions_.subsystem().local(parameter.parameter.name)));
    }
  }

  const TomlEntry& entry_;
  const Expressions& expressions_;
  const Report& report_;
};

}  // namespace

void ModelBlocks::read() { read(hierarchy_.root()); }

void ModelBlocks::read(Subsystem& subsystem) {
  subsystem.inside = add_ports(subsystem, subsystem, Role::inside);
  add_fallbacks(subsystem);
  for (const Member& member : subsystem.members) {
    if (!is_name(member.entry->key))
      subsystem.report.error(member.entry->at, message::not_a_name(member.entry->key));
    if (member.subsystem != nullptr) {
      add_subsystem(subsystem, member);
    } else {
      add_block(subsystem, member);
    }
  }
}

int ModelBlocks::add(const Subsystem& owner, const TomlEntry& entry, Role role) {
  Instance& instance = instances_.emplace_back();
  instance.name = owner.prefix + entry.key;
  instance.at = owner.report.here(entry.at);
  nodes_.push_back({role, &owner, nullptr, nullptr});
  return size() - 1;
}

void ModelBlocks::add_block(Subsystem& owner, const Member& member) {
  const int number = add(owner, *member.entry, Role::block);
  owner.blocks.emplace(member.entry->key, number);
  if (!member.refused) construct(number, *member.entry);
}

void ModelBlocks::add_subsystem(Subsystem& owner, const Member& member) {
  member.subsystem->outside = add_ports(owner, *member.subsystem, Role::outside);
  owner.blocks.emplace(member.entry->key, member.subsystem->outside);
  read(*member.subsystem);
}

int ModelBlocks::add_ports(const Subsystem& owner, Subsystem& subsystem, Role role) {
  static const TomlEntry model;
  const Subsystem& user = subsystem.user == nullptr ? subsystem : *subsystem.user;
  const int number = add(user, subsystem.entry == nullptr ? model : *subsystem.entry, role);
  const Interface& interface = subsystem.type.interface;
  const BlockForm& form = role == Role::outside ? *interface.outside : *interface.inside;
  nodes_[number] = {role, &owner, &subsystem, &form};
  instances_[number].object = form.object;
  for (const int slot : form.inputs) instances_[number].inputs.emplace_back(slot, Endpoint{});
  return number;
}

/// What stands in for wires that are not there.
void ModelBlocks::add_fallbacks(Subsystem& subsystem) {
  const Interface& interface = subsystem.type.interface;
  subsystem.fallback.assign(interface.outside->specification().slots.size(), -1);
  for (const Interface::Default& given : interface.defaults) {
    const Expressions expressions(parameters_, subsystem);
    for (const int slot : given.port->slots) {
      if (!expressions.bind(*given.value, interface.outside->specification().slots[slot].unit)) break;
    }
    for (const int slot : given.port->slots) add_fallback(subsystem, given, slot);
  }
}

/// Each element of a vector has a number of its own: their units may differ.
void ModelBlocks::add_fallback(Subsystem& subsystem, const Interface::Default& given, int slot) {
  const Expressions expressions(parameters_, subsystem);
  TomlEntry& entry = fallbacks_.emplace_back();
  entry.key = subsystem.type.interface.outside->specification().slots[slot].name;
  entry.at = given.entry->at;
  entry.value.entries.push_back({"value", given.value->at, *given.value});
  const int number = add(subsystem, entry, Role::fallback);
  const BlockForm* form = make(*find_block_type("Constant"), entry, expressions);
  nodes_[number].form = form;
  if (form == nullptr) return;
  instances_[number].object = form->object;
  Binder(entry, expressions).bind(*form, instances_[number]);
  subsystem.fallback[slot] = number;
}

void ModelBlocks::construct(int number, const TomlEntry& entry) {
  const Subsystem& owner = *nodes_[number].owner;
  const BlockType* type = type_of(owner, entry);
  if (type == nullptr) return;
  const Expressions expressions(parameters_, owner);
  const BlockForm* form = make(*type, entry, expressions);
  Instance& instance = instances_[number];
  instance.object = form->object;
  Binder(entry, expressions).bind(*form, instance);
  instance.inputs.reserve(form->inputs.size());
  for (const int slot : form->inputs) instance.inputs.emplace_back(slot, Endpoint{});
  // Ports of a structure that was refused are not those that were meant.
  const bool refused = !refused_.empty() && refused_.back().get() == form;
  if (!refused) nodes_[number].form = form;
}

const BlockType* ModelBlocks::type_of(const Subsystem& owner, const TomlEntry& entry) const {
  const Report& report = owner.report;
  if (!report.expect(entry.value, TomlValue::Kind::table, "a block such as { type = \"Gain\" }"))
    return nullptr;
  const TomlValue* name = entry.value.find("type");
  if (name == nullptr) {
    report.error(entry.at, message::missing_key("type", "block " + entry.key));
    return nullptr;
  }
  if (!report.expect(*name, TomlValue::Kind::string, "the name of a block type in quotes")) return nullptr;
  const BlockType* type = find_block_type(name->text);
  if (type == nullptr) report.error_inside(*name, 0, message::unknown_type(name->text, type_names(owner)));
  return type;
}

const BlockForm* ModelBlocks::make(const BlockType& type, const TomlEntry& entry,
                                   const Expressions& expressions) {
  const Report& report = expressions.subsystem().report;
  Made& made = made_[&type];
  TableSettings settings(entry, expressions, files_);
  const int errors_before = report.errors();
  const std::string structure = settings.structure(made.uses);
  const bool readable = report.errors() == errors_before;
  if (const auto found = made.forms.find(structure); readable && found != made.forms.end()) {
    check_settings(*found->second, entry, report);
    return found->second.get();
  }
  // What could not be read would be reported again by the constructor.
  auto form = std::make_unique<BlockForm>(type.create(readable ? &settings : nullptr));
  if (report.errors() != errors_before) return refused_.emplace_back(std::move(form)).get();
  check_settings(*form, entry, report);
  for (const auto& [key, use] : settings.uses()) made.uses[key] |= use;
  return made.forms.insert_or_assign(settings.structure(made.uses), std::move(form)).first->second.get();
}

void ModelBlocks::check_settings(const BlockForm& form, const TomlEntry& entry, const Report& report) const {
  const Specification& spec = form.specification();
  for (const TomlEntry& setting : entry.value.entries) {
    if (has_setting(spec, setting.key)) continue;
    const bool elsewhere = std::ranges::any_of(spec.absent, [&](const SlotSpec& slot) {
      return slot.kind == SlotKind::param && slot.name == setting.key;
    });
    const std::string owner = form.object->type->name;
    std::string wrong = elsewhere ? message::setting_of_other_structure(setting.key, owner)
                                  : message::unknown_setting(setting.key, owner, setting_names(spec));
    if (setting.value.override_index >= 0) {
      report.error(setting.value, std::move(wrong));
    } else {
      report.error(setting.at, std::move(wrong));
    }
  }
}

}  // namespace flyball
