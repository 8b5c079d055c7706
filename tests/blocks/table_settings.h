#pragma once

#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "blocks/settings.h"

namespace flyball::test {

using Numbers = std::vector<double>;
using Table = std::vector<Numbers>;
using Words = std::vector<std::string>;
using Value = std::variant<double, bool, std::string, Rational, Words, Numbers, Table,
                           std::shared_ptr<const Formula>, std::shared_ptr<const TimeSeries>>;
using Keys = std::map<std::string, Value, std::less<>>;

/// The text of a block as a table in memory. A value of the wrong kind is a mistake of the test, so it
/// throws.
class TableSettings : public Settings {
 public:
  explicit TableSettings(Keys keys) : keys_(std::move(keys)) {}

  /// What the block refused, as "key: message".
  const std::vector<std::string>& refused() const { return refused_; }

  bool given(std::string_view key) const override { return keys_.contains(key); }
  std::optional<std::string> text(std::string_view key) override { return get<std::string>(key); }
  std::optional<long> integer(std::string_view key) override { return get<double>(key); }
  std::optional<std::vector<long>> integers(std::string_view key) override {
    const auto numbers = get<Numbers>(key);
    if (!numbers) return std::nullopt;
    return std::vector<long>(numbers->begin(), numbers->end());
  }
  std::optional<bool> flag(std::string_view key) override { return get<bool>(key); }
  std::optional<Rational> exact(std::string_view key) override { return get<Rational>(key); }
  std::optional<std::vector<std::string>> list(std::string_view key) override { return get<Words>(key); }
  std::optional<Shape> shape(std::string_view key) override {
    if (!given(key)) return std::nullopt;
    const Value& value = keys_.find(key)->second;
    const Table table =
        std::holds_alternative<Numbers>(value) ? Table{std::get<Numbers>(value)} : std::get<Table>(value);
    Shape shape{static_cast<int>(table.size()), table.empty() ? 0 : static_cast<int>(table[0].size()), {}};
    for (const Numbers& row : table) {
      for (const double entry : row) shape.zero.push_back(entry == 0.0);
    }
    return shape;
  }
  std::shared_ptr<const Formula> formula(std::string_view key, const std::vector<std::string>&) override {
    return get<std::shared_ptr<const Formula>>(key).value_or(nullptr);
  }
  std::optional<NumberRows> lengths(std::string_view key) override { return get<Table>(key); }
  std::optional<NumberRows> columns(std::string_view file, const std::vector<std::string>&,
                                    const std::string&) override {
    return get<Table>(file);
  }
  std::shared_ptr<const TimeSeries> time_series(std::string_view file, std::string_view) override {
    return get<std::shared_ptr<const TimeSeries>>(file).value_or(nullptr);
  }
  void refuse(std::string_view key, std::string message) override {
    refused_.push_back(std::string(key) + ": " + message);
  }

  /// The number that the table gives for a parameter, if it does.
  std::optional<double> number(const SlotSpec& slot) const {
    const auto found = keys_.find(slot.setting);
    if (found == keys_.end()) return std::nullopt;
    if (const auto* one = std::get_if<double>(&found->second)) return *one;
    if (const auto* exact = std::get_if<Rational>(&found->second)) return exact->value();
    if (const auto* row = std::get_if<Numbers>(&found->second)) return row->at(slot.entry);
    const Table& table = std::get<Table>(found->second);
    const int columns = static_cast<int>(table[0].size());
    return table.at(slot.entry / columns).at(slot.entry % columns);
  }

 private:
  template <class T>
  std::optional<T> get(std::string_view key) const {
    const auto found = keys_.find(key);
    if (found == keys_.end()) return std::nullopt;
    return std::get<T>(found->second);
  }

  Keys keys_;
  std::vector<std::string> refused_;
};

}  // namespace flyball::test
