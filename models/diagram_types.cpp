#include "models/diagram_types.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "models/diagram_files.h"
#include "models/diagram_overrides.h"
#include "models/language/messages.h"
#include "models/read_file.h"

namespace flyball {
namespace {

using Kind = TomlValue::Kind;
using Progress = SubsystemType::Progress;

constexpr int format_version = 1;

const TomlValue* type_of(const TomlEntry& block) {
  const TomlValue* type = block.value.is(Kind::table) ? block.value.find("type") : nullptr;
  return type != nullptr && type->is(Kind::string) ? type : nullptr;
}

/// A definition of this name that expressions and blocks of `type` see.
SubsystemType* find_local(const SubsystemType& type, std::string_view name) {
  for (const SubsystemType* from = &type; from != nullptr; from = from->outer) {
    if (const auto found = from->local.find(name); found != from->local.end()) return found->second.get();
  }
  return nullptr;
}

}  // namespace

const SubsystemType* SubsystemTypes::read(std::string_view text) {
  SubsystemType* model = add_file(text, diagnostics_.file(), 0);
  if (model == nullptr) return nullptr;
  apply_to_parameters(overrides_, documents_.front().root(), diagnostics_);
  start(*model, 0);
  check(*model);
  return model;
}

std::vector<UsedFile> SubsystemTypes::used_files() const { return used_files_; }

SubsystemType* SubsystemTypes::add_file(std::string_view text, const std::string& file, int source) {
  auto document = parse_toml(text, diagnostics_, source);
  SubsystemType*& type = by_identity_[identity_of(file)];
  if (!document) return nullptr;
  documents_.push_back(std::move(*document));
  type = &files_.emplace_back();
  type->name = file;
  type->document = &documents_.back();
  type->body = &documents_.back().root();
  type->at = {1, 1, source};
  return type;
}

void SubsystemTypes::start(SubsystemType& type, int source) {
  type.source = source;
  type.number = numbers_++;
  const Report report(*type.document, overrides_, diagnostics_, source);
  type.interface = read_interface(find_table(*type.body, "ports"), type.name, report);
}

void SubsystemTypes::check(SubsystemType& type) {
  const Report report(*type.document, overrides_, diagnostics_, type.source);
  type.progress = Progress::open;
  open_.push_back(&type);
  check_keys(type, report);
  declare_local(type, report);
  if (const TomlValue* blocks = find_table(*type.body, "blocks")) {
    for (const TomlEntry& block : blocks->entries) {
      if (type.interface.port(block.key) != nullptr)
        report.error(block.at, message::block_and_port(block.key));
      const auto used = use(type, block, report);
      if (used) type.uses.emplace(block.key, *used);
      if (used && *used != nullptr) type.height = std::max(type.height, (*used)->height + 1);
      type.blocks += used && *used != nullptr ? (*used)->blocks : 1;
    }
  }
  for (const auto& [name, local] : type.local) {
    if (local->progress == Progress::declared) report.warning(local->at, message::unused_subsystem(name));
  }
  open_.pop_back();
  type.progress = Progress::checked;
}

void SubsystemTypes::check_keys(const SubsystemType& type, const Report& report) const {
  const TomlValue& body = *type.body;
  if (type.is_file()) {
    report.check_keys(body, "a model file",
                      {"flyball", "model", "parameters", "ports", "subsystems", "blocks", "diagram",
                       "simulation", "metrics", "requirements"});
    check_version(body, report);
  } else {
    report.check_keys(body, "subsystem " + type.name,
                      {"doc", "parameters", "ports", "subsystems", "blocks", "diagram"});
    report.text(body, "doc");
  }
  for (const char* name : {"model", "parameters", "ports", "subsystems", "blocks", "diagram", "simulation",
                           "metrics", "requirements"}) {
    if (const TomlValue* section = body.find(name)) report.expect(*section, Kind::table, "a section");
  }
  if (type.is_file() && body.find("blocks") == nullptr)
    report.error({1, 1, type.source}, message::missing_section("blocks"));
  if (const TomlValue* diagram = find_table(body, "diagram")) {
    report.check_keys(*diagram, "[diagram]",
                      type.is_file() ? std::vector<std::string>{"wires", "log", "guesses"}
                                     : std::vector<std::string>{"wires"});
  }
}

void SubsystemTypes::check_version(const TomlValue& body, const Report& report) const {
  const TomlValue* version = body.find("flyball");
  if (version == nullptr)
    return report.error({1, 1, body.at.source}, message::missing_version(format_version));
  if (!report.expect(*version, Kind::integer, "the version of the file format")) return;
  if (version->integer != format_version)
    report.error(*version, message::unknown_version(version->integer, format_version));
}

void SubsystemTypes::declare_local(SubsystemType& type, const Report& report) {
  const TomlValue* section = find_table(*type.body, "subsystems");
  if (section == nullptr) return;
  for (const TomlEntry& entry : section->entries) {
    if (!report.expect(entry.value, Kind::table, "a subsystem such as [subsystems.Wheel]")) continue;
    if (!is_name(entry.key)) report.error(entry.at, message::not_a_name(entry.key));
    // A name means one thing wherever it is seen.
    if (find_block_type(entry.key) != nullptr) report.error(entry.at, message::name_of_block_type(entry.key));
    if (const SubsystemType* other = find_local(type, entry.key)) {
      report.error(entry.at, message::stands_twice(entry.key));
      report.note(other->at, message::first_stands_here(entry.key));
    }
    auto local = std::make_unique<SubsystemType>();
    local->name = entry.key;
    local->document = type.document;
    local->body = &entry.value;
    local->at = entry.at;
    local->outer = &type;
    type.local.emplace(entry.key, std::move(local));
  }
}

std::optional<SubsystemType*> SubsystemTypes::use(const SubsystemType& type, const TomlEntry& block,
                                                  const Report& report) {
  const TomlValue* name = type_of(block);
  if (name == nullptr) return std::nullopt;
  if (name->text.ends_with(".toml")) return accept(open_file(type, block, report), type, block, report);
  SubsystemType* local = find_local(type, name->text);
  if (local == nullptr) return std::nullopt;
  if (local->progress == Progress::declared) {
    const std::string& file = diagnostics_.file(type.source);
    start(*local, diagnostics_.add_source(file, report.here(name->at), block.key));
  }
  return accept(local, type, block, report);
}

SubsystemType* SubsystemTypes::accept(SubsystemType* used, const SubsystemType& user, const TomlEntry& block,
                                      const Report& report) {
  if (used == nullptr) return nullptr;
  const auto refuse = [&](std::string message) -> SubsystemType* {
    report.error_inside(*type_of(block), 0, std::move(message));
    return nullptr;
  };
  if (used->progress == Progress::open) return refuse(message::cyclic_subsystems(chain_to(*used)));
  if (used->is_file() && used->body->find("ports") == nullptr) return refuse(message::file_without_ports());
  const auto depth = static_cast<int>(open_.size());
  if (used->progress == Progress::declared && depth < deepest_hierarchy) check(*used);
  if (depth + used->height > deepest_hierarchy) return refuse(message::hierarchy_too_deep(deepest_hierarchy));
  if (user.blocks + used->blocks > most_blocks) return refuse(message::too_many_blocks(most_blocks));
  return used;
}

SubsystemType* SubsystemTypes::open_file(const SubsystemType& user, const TomlEntry& block,
                                         const Report& report) {
  const TomlValue& name = *type_of(block);
  const std::string file = path_beside(diagnostics_.file(user.source), name.text);
  const auto known = by_identity_.find(identity_of(file));
  if (known != by_identity_.end()) return known->second;
  errno = 0;
  const auto text = read_file_content(file);
  if (!text) {
    report.error_inside(name, 0, message::unreadable_file(file, std::strerror(errno)));
    return nullptr;
  }
  const int source = diagnostics_.add_source(file, report.here(name.at), block.key);
  used_files_.push_back({file, *text});
  SubsystemType* type = add_file(*text, file, source);
  if (type == nullptr) return nullptr;
  type->name = name.text;
  start(*type, source);
  return type;
}

std::string SubsystemTypes::chain_to(const SubsystemType& type) const {
  const auto name = [&](const SubsystemType* link) {
    return link->is_file() ? diagnostics_.file(link->source) : link->name;
  };
  std::vector<std::string> names;
  for (auto at = std::ranges::find(open_, &type); at != open_.end(); ++at) names.push_back(name(*at));
  names.push_back(name(&type));
  return fmt::format("{}", fmt::join(names, " -> "));
}

}  // namespace flyball
