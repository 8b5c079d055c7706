#include "models/diagram_blocks.h"

#include <algorithm>

#include "models/language/messages.h"

namespace flyball {
namespace {

std::unique_ptr<BlockForm> form_of(BlockObject object) {
  auto form = std::make_unique<BlockForm>();
  form->object = std::make_shared<const BlockObject>(std::move(object));
  const auto& slots = form->specification().slots;
  form->input_rank.assign(slots.size(), -1);
  for (int s = 0; s < static_cast<int>(slots.size()); ++s) {
    if (slots[s].kind == SlotKind::param) form->params.push_back(s);
    if (slots[s].kind != SlotKind::input && slots[s].kind != SlotKind::object_input) continue;
    form->input_rank[s] = static_cast<int>(form->inputs.size());
    form->inputs.push_back(s);
  }
  return form;
}

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

}  // namespace

void ModelBlocks::read(const TomlValue& section) {
  instances_.reserve(section.entries.size());
  for (const TomlEntry& entry : section.entries) {
    if (!is_name(entry.key)) report_.error(entry.at, message::not_a_name(entry.key));
    names_.emplace(entry.key, static_cast<int>(instances_.size()));
    Instance& instance = instances_.emplace_back();
    instance.name = entry.key;
    instance.at = entry.at;
    const BlockType* type = type_of(entry);
    const BlockForm* form = type == nullptr ? nullptr : make(*type, entry);
    if (form != nullptr) bind(*form, entry, instance);
    // Ports of a structure that was refused are not those that were meant.
    const bool refused = !refused_.empty() && refused_.back().get() == form;
    forms_.push_back(refused ? nullptr : form);
  }
}

int ModelBlocks::find(std::string_view name) const {
  const auto found = names_.find(name);
  return found == names_.end() ? -1 : found->second;
}

std::vector<std::string> ModelBlocks::names() const {
  std::vector<std::string> result;
  for (const Instance& instance : instances_) result.push_back(instance.name);
  return result;
}

const BlockType* ModelBlocks::type_of(const TomlEntry& entry) {
  if (!report_.expect(entry.value, TomlValue::Kind::table, "a block such as { type = \"Gain\" }"))
    return nullptr;
  const TomlValue* name = entry.value.find("type");
  if (name == nullptr) {
    report_.error(entry.at, message::missing_key("type", "block " + entry.key));
    return nullptr;
  }
  if (!report_.expect(*name, TomlValue::Kind::string, "the name of a block type in quotes")) return nullptr;
  const BlockType* type = find_block_type(name->text);
  if (type == nullptr) report_.error_inside(*name, 0, message::unknown_type(name->text, block_type_names()));
  return type;
}

const BlockForm* ModelBlocks::make(const BlockType& type, const TomlEntry& entry) {
  Made& made = made_[&type];
  TableSettings settings(entry, parameters_, files_, report_);
  const int errors_before = report_.errors();
  const std::string structure = settings.structure(made.uses);
  const bool readable = report_.errors() == errors_before;
  if (const auto found = made.forms.find(structure); readable && found != made.forms.end()) {
    check_settings(*found->second, entry);
    return found->second.get();
  }
  // What could not be read would be reported again by the constructor.
  auto form = form_of(type.create(readable ? &settings : nullptr));
  if (report_.errors() != errors_before) return refused_.emplace_back(std::move(form)).get();
  check_settings(*form, entry);
  for (const auto& [key, use] : settings.uses()) made.uses[key] |= use;
  return made.forms.insert_or_assign(settings.structure(made.uses), std::move(form)).first->second.get();
}

void ModelBlocks::check_settings(const BlockForm& form, const TomlEntry& entry) {
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
      report_.error(setting.value, std::move(wrong));
    } else {
      report_.error(setting.at, std::move(wrong));
    }
  }
}

void ModelBlocks::bind(const BlockForm& form, const TomlEntry& entry, Instance& instance) {
  const auto& slots = form.specification().slots;
  instance.object = form.object;
  instance.parameters.reserve(form.params.size());
  for (const int s : form.params) {
    auto binding = bind(slots[s], entry);
    if (binding) instance.parameters.emplace_back(s, *std::move(binding));
  }
  check_order(form, entry, instance);
  instance.inputs.reserve(form.inputs.size());
  for (const int s : form.inputs) instance.inputs.emplace_back(s, Endpoint{});
}

std::optional<Binding> ModelBlocks::bind(const SlotSpec& slot, const TomlEntry& entry) {
  Binding binding;
  binding.value = slot.fallback;
  binding.at = entry.at;
  if (!slot.reference.empty()) {
    binding.kind = Binding::Kind::parameter;
    binding.parameter = parameters_.find(slot.reference);
    return binding;
  }
  const TomlValue* value = slot.fixed ? nullptr : entry.value.find(slot.setting);
  if (value == nullptr) return binding;
  if (slot.entry >= 0) {
    value = entry_of(*value, slot.entry);
    const bool refused = value == nullptr || !(value->numeric() || value->is(TomlValue::Kind::string));
    if (refused) return std::nullopt;
  }
  auto given = parameters_.bind(*value, slot.unit);
  if (given) check_range(slot, *given, *value);
  return given;
}

void ModelBlocks::check_order(const BlockForm& form, const TomlEntry& entry, const Instance& instance) {
  const auto& slots = form.specification().slots;
  const Binding* before = nullptr;
  int slot_before = -1;
  for (const auto& [s, binding] : instance.parameters) {
    const TomlValue* list = entry.value.find(slots[s].setting);
    if (slots[s].exceeds >= 0 && slots[s].exceeds == slot_before && list != nullptr) {
      const double value = parameters_.value(binding), least = parameters_.value(*before);
      if (!(value > least)) {
        report_.error(*entry_of(*list, slots[s].entry), message::not_increasing(slots[s].name, value, least));
      }
    }
    before = &binding;
    slot_before = s;
  }
}

void ModelBlocks::check_range(const SlotSpec& slot, const Binding& binding, const TomlValue& value) {
  const double number = parameters_.value(binding);
  if (slot.range.contains(number)) return;
  report_.error(value, message::out_of_range(slot.name, number, slot.range, slot.unit));
  std::vector<int> used = binding.operands;
  if (binding.kind == Binding::Kind::parameter) used.push_back(binding.parameter);
  for (const int parameter : used) {
    report_.note(parameters_.position(parameter), message::declared_here(parameters_.name(parameter)));
  }
}

}  // namespace flyball
