#pragma once

#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "models/diagram.h"
#include "models/diagram_interface.h"
#include "models/diagram_report.h"
#include "models/language/names.h"

namespace flyball {

/// A definition that blocks can be made from: a file, or [subsystems.NAME] in one. The model itself is one,
/// too.
struct SubsystemType {
  std::string name;  // as its first user writes it: "Wheel", "../library/motor.toml"
  const TomlDocument* document = nullptr;
  const TomlValue* body = nullptr;
  const SubsystemType* outer = nullptr;  // in which it is defined, and whose names it sees; nullptr of a file
  Position at;                           // where it is declared
  int source = 0;                        // of the diagnostics: its first use
  int number = 0;                        // in the order of first use
  Interface interface;
  NameMap<std::unique_ptr<SubsystemType>> local;  // [subsystems]
  NameMap<SubsystemType*> uses;  // of the blocks that are subsystems: nullptr where it was refused
  enum class Progress { declared, open, checked } progress = Progress::declared;
  int height = 1;   // levels from here on down
  long blocks = 0;  // of the catalogue, in one use

  bool is_file() const { return outer == nullptr; }
};

/// More levels than this are refused.
inline constexpr int deepest_hierarchy = 100;
/// A model that unfolds to more blocks than this is refused.
inline constexpr long most_blocks = 1'000'000;

/// All definitions that a model uses. Each file is read once, each definition checked once, whatever the
/// number of its uses.
class SubsystemTypes {
 public:
  SubsystemTypes(const std::vector<Override>& overrides, Diagnostics& diagnostics)
      : overrides_(overrides), diagnostics_(diagnostics) {}

  /// The model whose text is given; nullptr when it is no TOML. Reports what no use can put right: unknown
  /// keys, ports, files that cannot be read, and definitions that contain themselves.
  const SubsystemType* read(std::string_view text);

  /// The files that were read besides the model.
  std::vector<UsedFile> used_files() const;

 private:
  SubsystemType* add_file(std::string_view text, const std::string& file, int source);
  void check(SubsystemType& type);
  void check_keys(const SubsystemType& type, const Report& report) const;
  void check_version(const TomlValue& body, const Report& report) const;
  void declare_local(SubsystemType& type, const Report& report);
  /// What a block of `type` is a use of: nothing when it is no subsystem, nullptr when it was refused.
  std::optional<SubsystemType*> use(const SubsystemType& type, const TomlEntry& block, const Report& report);
  SubsystemType* accept(SubsystemType* used, const SubsystemType& user, const TomlEntry& block,
                        const Report& report);
  SubsystemType* open_file(const SubsystemType& user, const TomlEntry& block, const Report& report);
  /// At its first use.
  void start(SubsystemType& type, int source);
  std::string chain_to(const SubsystemType& type) const;

  const std::vector<Override>& overrides_;
  Diagnostics& diagnostics_;
  std::deque<TomlDocument> documents_;
  std::deque<SubsystemType> files_;
  NameMap<SubsystemType*> by_identity_;  // nullptr: no TOML
  std::vector<UsedFile> used_files_;
  std::vector<const SubsystemType*> open_;  // from the model to what is being checked
  int numbers_ = 0;
};

}  // namespace flyball
