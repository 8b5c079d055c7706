#include "models/diagram_hierarchy.h"

#include "models/diagram_overrides.h"
#include "models/language/messages.h"

namespace flyball {

int Subsystem::find_parameter(std::string_view name) const {
  for (const Scope* at = &scope; at != nullptr; at = at->outer) {
    if (const auto found = at->parameters->find(name); found != at->parameters->end()) return found->second;
  }
  return -1;
}

Hierarchy::Hierarchy(const SubsystemType& model, const std::vector<Override>& overrides,
                     Diagnostics& diagnostics)
    : overrides_(overrides), diagnostics_(diagnostics) {
  for (std::size_t k = 0; k < overrides.size(); ++k) {
    const std::size_t dot = overrides[k].name.rfind('.');
    if (dot == std::string::npos) continue;
    of_block_[overrides[k].name.substr(0, dot)].push_back(static_cast<int>(k));
  }
  unfold(add(model, 0));
  for (std::size_t k = 0; k < overrides.size(); ++k) check_override(static_cast<int>(k));
}

Subsystem& Hierarchy::add(const SubsystemType& type, int source) {
  const Report report(*type.document, overrides_, diagnostics_, source);
  Subsystem& added = *all_.emplace_back(std::make_unique<Subsystem>(type, report));
  added.scope.parameters = &added.parameters;
  return added;
}

void Hierarchy::unfold(Subsystem& subsystem) {
  const TomlValue* blocks = subsystem.section("blocks");
  if (blocks == nullptr) return;
  subsystem.members.reserve(blocks->entries.size());
  for (const TomlEntry& entry : blocks->entries) {
    Member& member = subsystem.members.emplace_back();
    member.entry = of_block_.empty() ? &entry : overridden(subsystem.prefix + entry.key, entry);
    const auto used = subsystem.type.uses.find(entry.key);
    if (used == subsystem.type.uses.end()) continue;
    member.refused = used->second == nullptr;
    if (!member.refused) member.subsystem = &add_member(subsystem, *used->second, *member.entry);
  }
}

Subsystem& Hierarchy::add_member(Subsystem& user, const SubsystemType& type, const TomlEntry& entry) {
  const TomlValue& name = *entry.value.find("type");
  if (name.override_index >= 0) user.report.error(name, message::subsystem_keeps_type());
  const Position used = user.report.here(name.at);
  const int source = diagnostics_.add_source(diagnostics_.file(type.source), used, entry.key);
  Subsystem& added = add(type, source);
  added.user = &user;
  added.entry = &entry;
  added.prefix = user.prefix + entry.key + '.';
  // A definition inside another one sees the names of the use that it is part of.
  for (const Subsystem* seen = &user; seen != nullptr && !type.is_file(); seen = seen->user) {
    if (&seen->type != type.outer) continue;
    added.scope.outer = &seen->scope;
    break;
  }
  unfold(added);
  return added;
}

const TomlEntry* Hierarchy::overridden(const std::string& path, const TomlEntry& entry) {
  const auto found = of_block_.find(path);
  if (found == of_block_.end() || !entry.value.is(TomlValue::Kind::table)) return &entry;
  TomlEntry& changed = changed_.emplace_back(entry);
  for (const int number : found->second) apply_to_block(overrides_, number, changed, diagnostics_);
  return &changed;
}

void Hierarchy::check_override(int number) const {
  const std::string& name_given = overrides_[number].name;
  const std::size_t dot = name_given.rfind('.');
  if (dot == std::string::npos) return;
  const Subsystem* at = &root();
  std::string_view rest = std::string_view(name_given).substr(0, dot);
  while (true) {
    const std::string_view name = rest.substr(0, rest.find('.'));
    const Member* found = nullptr;
    std::vector<std::string> names;
    for (const Member& member : at->members) {
      names.push_back(member.entry->key);
      if (member.entry->key == name) found = &member;
    }
    const bool last = name.size() == rest.size();
    if (found != nullptr && (last || found->refused)) return;
    if (found == nullptr || found->subsystem == nullptr) {
      const std::string wrong =
          found == nullptr ? message::unknown_block(name, names) : message::no_parts(name);
      return diagnostics_.error({}, message::in_override(name_given, wrong));
    }
    at = found->subsystem;
    rest.remove_prefix(name.size() + 1);
  }
}

}  // namespace flyball
