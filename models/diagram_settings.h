#pragma once

#include <map>
#include <string>

#include "blocks/settings.h"
#include "models/diagram_data.h"
#include "models/diagram_expressions.h"

namespace flyball {

/// The settings of one block, from its table in a model file.
class TableSettings : public Settings {
 public:
  /// How a key was read: more than one bit may be set.
  enum Use : unsigned {
    as_written = 1,
    as_time = 2,
    as_whole = 4,
    as_shape = 8,
    as_formula = 16,
    as_file = 32,
    as_lengths = 64
  };
  using Uses = std::map<std::string, unsigned, std::less<>>;

  TableSettings(const TomlEntry& block, const Expressions& expressions, DataFiles& files)
      : block_(block),
        expressions_(expressions),
        files_(files),
        report_(expressions.subsystem().report),
        errors_before_(report_.errors()) {}

  bool given(std::string_view key) const override;
  std::optional<std::string> text(std::string_view key) override;
  std::optional<long> integer(std::string_view key) override;
  std::optional<std::vector<long>> integers(std::string_view key) override;
  std::optional<bool> flag(std::string_view key) override;
  std::optional<Rational> exact(std::string_view key) override;
  std::optional<std::vector<std::string>> list(std::string_view key) override;
  std::optional<Shape> shape(std::string_view key) override;
  std::shared_ptr<const Formula> formula(std::string_view key,
                                         const std::vector<std::string>& inputs) override;
  std::optional<NumberRows> lengths(std::string_view key) override;
  std::optional<NumberRows> columns(std::string_view file, const std::vector<std::string>& names,
                                    const std::string& unit) override;
  std::shared_ptr<const TimeSeries> time_series(std::string_view file, std::string_view column) override;
  void refuse(std::string_view key, std::string message) override;

  /// All that the block's constructor has asked for: its structure depends on nothing else.
  const Uses& uses() const { return uses_; }
  /// The answers to `uses` as one text: blocks with equal texts have equal structure.
  std::string structure(const Uses& uses);

 private:
  const TomlValue* find(std::string_view key, Use use) const;
  std::string path_of(const TomlValue& file) const;
  std::optional<std::vector<double>> length_row(const TomlValue& row) const;
  void append_exact(std::string& result, const TomlValue& value, const std::string& unit);
  void append_shape(std::string& result, std::string_view key);
  void append_lengths(std::string& result, std::string_view key);
  void append_formula(std::string& result, const TomlValue& value);

  const TomlEntry& block_;
  const Expressions& expressions_;
  DataFiles& files_;
  const Report& report_;
  int errors_before_;
  int refusals_ = 0;
  mutable Uses uses_;
};

}  // namespace flyball
