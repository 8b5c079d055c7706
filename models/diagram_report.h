#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "models/diagram.h"
#include "models/language/diagnostics.h"
#include "models/language/toml.h"

namespace flyball {

/// Says what is wrong with values of a model, where they stand: in the file, or in an override.
class Report {
 public:
  Report(const TomlDocument& document, const std::vector<Override>& overrides, Diagnostics& diagnostics)
      : document_(document), overrides_(overrides), diagnostics_(diagnostics) {}

  void error(Position at, std::string message) { diagnostics_.error(at, std::move(message)); }
  /// Belongs to the error before it; nothing when the place is not in the file.
  void note(Position at, std::string message);
  void error(const TomlValue& value, std::string message);
  /// At byte `offset` of the content of a string.
  void error_inside(const TomlValue& string, std::size_t offset, std::string message);
  Position inside(const TomlValue& string, std::size_t offset) const {
    return document_.inside(string, offset);
  }
  const std::string& file() const { return diagnostics_.file(); }
  int errors() const { return diagnostics_.errors(); }

  /// Whether the value has this kind; else an error that says what was expected.
  bool expect(const TomlValue& value, TomlValue::Kind kind, std::string_view expected);
  /// An error for each key of a table that is not among the known ones.
  void check_keys(const TomlValue& table, std::string_view owner, const std::vector<std::string>& known);
  /// The text under a key, empty without it.
  std::string text(const TomlValue& table, std::string_view key);

 private:
  const TomlDocument& document_;
  const std::vector<Override>& overrides_;
  Diagnostics& diagnostics_;
};

}  // namespace flyball
