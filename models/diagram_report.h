#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "models/diagram.h"
#include "models/language/diagnostics.h"
#include "models/language/toml.h"

namespace flyball {

/// Says what is wrong with values of a model, where they stand: in a file, or in an override.
class Report {
 public:
  /// What stands in `document` is reported in source `source` of the diagnostics: one use of the document.
  Report(const TomlDocument& document, const std::vector<Override>& overrides, Diagnostics& diagnostics,
         int source)
      : document_(document), overrides_(overrides), diagnostics_(diagnostics), source_(source) {}

  void error(Position at, std::string message) const { diagnostics_.error(here(at), std::move(message)); }
  /// Belongs to the error before it; nothing when the place is not in a file.
  void note(Position at, std::string message) const;
  void error(const TomlValue& value, std::string message) const;
  /// At byte `offset` of the content of a string.
  void error_inside(const TomlValue& string, std::size_t offset, std::string message) const;
  void warning(Position at, std::string message) const { diagnostics_.warning(here(at), std::move(message)); }
  Position inside(const TomlValue& string, std::size_t offset) const {
    return document_.inside(string, offset);
  }
  const std::string& file() const { return diagnostics_.file(source_); }
  /// The same place in this use of the document; a place in another file stays what it is.
  Position here(Position at) const;
  int errors() const { return diagnostics_.errors(); }

  /// Whether the value has this kind; else an error that says what was expected.
  bool expect(const TomlValue& value, TomlValue::Kind kind, std::string_view expected) const;
  /// An error for each key of a table that is not among the known ones.
  void check_keys(const TomlValue& table, std::string_view owner,
                  const std::vector<std::string>& known) const;
  /// The text under a key, empty without it.
  std::string text(const TomlValue& table, std::string_view key) const;
  /// A unit in SI; nothing when it is none.
  std::optional<std::string> unit(const TomlValue& value) const;

 private:
  const TomlDocument& document_;
  const std::vector<Override>& overrides_;
  Diagnostics& diagnostics_;
  int source_;
};

/// The table under a key; nullptr when there is none.
const TomlValue* find_table(const TomlValue& table, std::string_view key);

}  // namespace flyball
