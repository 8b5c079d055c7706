#include "models/language/units.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "models/language/messages.h"

namespace flyball {
namespace {

struct NamedUnit {
  const char* name;
  double factor;        // used where it is no fraction
  Rational exact;       // 0: no fraction
  Dimension dimension;  // m, kg, s, A, K, mol, cd
  bool takes_prefix = false;
};

Rational over(std::int64_t numerator, std::int64_t denominator) {
  return *Rational::fraction(numerator, denominator);
}

/// The table of all units. "degC" counts from 273.15 K, which is added by whoever reads a whole value.
const std::vector<NamedUnit>& table() {
  static const std::vector<NamedUnit> units{
      {"1", 1, 1, {}},
      {"%", 0.01, over(1, 100), {}},
      {"m", 1, 1, {{1}}, true},
      {"g", 0.001, over(1, 1000), {{0, 1}}, true},
      {"s", 1, 1, {{0, 0, 1}}, true},
      {"min", 60, 60, {{0, 0, 1}}},
      {"h", 3600, 3600, {{0, 0, 1}}},
      {"Hz", 1, 1, {{0, 0, -1}}, true},
      {"rpm", 2 * M_PI / 60, 0, {{0, 0, -1}}},
      {"rad", 1, 1, {}, true},
      {"deg", M_PI / 180, 0, {}},
      {"rev", 2 * M_PI, 0, {}},
      {"N", 1, 1, {{1, 1, -2}}, true},
      {"J", 1, 1, {{2, 1, -2}}, true},
      {"W", 1, 1, {{2, 1, -3}}, true},
      {"Pa", 1, 1, {{-1, 1, -2}}, true},
      {"A", 1, 1, {{0, 0, 0, 1}}, true},
      {"V", 1, 1, {{2, 1, -3, -1}}, true},
      {"ohm", 1, 1, {{2, 1, -3, -2}}, true},
      {"F", 1, 1, {{-2, -1, 4, 2}}, true},
      {"H", 1, 1, {{2, 1, -2, -2}}, true},
      {"T", 1, 1, {{0, 1, -2, -1}}, true},
      {"K", 1, 1, {{0, 0, 0, 0, 1}}, true},
      {"degC", 1, 1, {{0, 0, 0, 0, 1}}},
      {"mol", 1, 1, {{0, 0, 0, 0, 0, 1}}, true},
      {"cd", 1, 1, {{0, 0, 0, 0, 0, 0, 1}}, true},
      {"L", 0.001, over(1, 1000), {{3}}, true},
  };
  return units;
}

struct Prefix {
  std::string_view text;
  Rational factor;
};

const std::vector<Prefix>& prefixes() {
  static const std::vector<Prefix> all{
      {"T", 1'000'000'000'000},
      {"G", 1'000'000'000},
      {"M", 1'000'000},
      {"k", 1000},
      {"h", 100},
      {"da", 10},
      {"d", over(1, 10)},
      {"c", over(1, 100)},
      {"m", over(1, 1000)},
      {"u", over(1, 1'000'000)},
      {"\u00B5", over(1, 1'000'000)},  // micro sign
      {"\u03BC", over(1, 1'000'000)},  // Greek mu
      {"n", over(1, 1'000'000'000)},
      {"p", over(1, 1'000'000'000'000)},
  };
  return all;
}

Unit made_of(const NamedUnit& named, const Rational& prefix) {
  Unit unit;
  unit.dimension = named.dimension;
  unit.hertz = std::string_view(named.name) == "Hz";
  if (std::string_view(named.name) == "degC") unit.offset = 273.15;
  unit.exact = named.exact == Rational(0) ? std::nullopt : multiply(named.exact, prefix);
  unit.factor = unit.exact ? unit.exact->value() : named.factor * prefix.value();
  return unit;
}

std::optional<Unit> find_unit(std::string_view name) {
  if (name == "\u03A9" || name == "\u2126") name = "ohm";
  const auto exactly = std::ranges::find(table(), name, &NamedUnit::name);
  if (exactly != table().end()) return made_of(*exactly, 1);
  for (const Prefix& prefix : prefixes()) {
    if (!name.starts_with(prefix.text)) continue;
    const auto base = std::ranges::find(table(), name.substr(prefix.text.size()), &NamedUnit::name);
    if (base != table().end() && base->takes_prefix) return made_of(*base, prefix.factor);
  }
  return std::nullopt;
}

bool name_character(char c) {
  // Bytes of letters outside ASCII: the micro sign, Greek mu and omega.
  return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_' ||
         static_cast<unsigned char>(c) >= 0x80;
}

class UnitParser {
 public:
  UnitParser(std::string_view text, std::size_t at, const std::function<bool(std::string_view)>* ends_at)
      : text_(text), at_(at), ends_at_(ends_at) {}

  std::size_t at() const { return at_; }
  bool done() { return skip_space(), at_ == text_.size(); }

  Unit product(int depth) {
    std::size_t start = at_;
    Unit unit = factor(depth);
    while (true) {
      const std::size_t before = at_;
      skip_space();
      const bool times = next_is('*');
      if (!times && !next_is('/')) return at_ = before, unit;
      ++at_;
      skip_space();
      if (embedded() && !unit_follows(depth)) return at_ = before, unit;
      unit = combined(unit, factor(depth), times, start);
    }
  }

  /// Whether a unit can start here: in an expression, what else might follow is not for us.
  bool unit_follows(int depth) {
    if (next_is('(')) return parenthesis_is_unit(depth);
    if (next_is('%')) return true;
    const std::string_view name = peek_name();
    if (name.empty() || (*ends_at_)(name)) return false;
    std::size_t after = text_.find_first_not_of(' ', at_ + name.size());
    if (after != std::string_view::npos && text_[after] == '(') return false;
    return find_unit(name).has_value();
  }

  /// "0.5 1/s".
  bool reciprocal_follows() const {
    UnitParser trial(*this);
    if (!trial.next_is('1')) return false;
    ++trial.at_;
    trial.skip_space();
    if (!trial.next_is('/')) return false;
    ++trial.at_;
    trial.skip_space();
    return trial.unit_follows(0);
  }

  std::string_view peek_name() const {
    std::size_t end = at_;
    const auto digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
    while (end < text_.size() && (name_character(text_[end]) || (end > at_ && digit(text_[end])))) ++end;
    return text_.substr(at_, end - at_);
  }

 private:
  bool embedded() const { return ends_at_ != nullptr; }
  bool next_is(char c) const { return at_ < text_.size() && text_[at_] == c; }
  void skip_space() {
    while (next_is(' ') || next_is('\t')) ++at_;
  }

  bool parenthesis_is_unit(int depth) {
    // Each level is tried before it is read, so the work doubles with each.
    constexpr int deepest = 4;
    if (depth >= deepest) return false;
    try {
      UnitParser trial(text_, at_, ends_at_);
      ++trial.at_;
      trial.skip_space();
      if (!trial.unit_follows(depth + 1)) return false;
      trial.at_ = at_;
      trial.factor(depth);
      return true;
    } catch (const TextError&) {
      return false;
    }
  }

  Unit factor(int depth) {
    constexpr int deepest = 32;
    skip_space();
    const std::size_t start = at_;
    if (depth > deepest) throw TextError(start, message::expression_too_deep());
    Unit unit;
    if (next_is('(')) {
      ++at_;
      unit = product(depth + 1);
      skip_space();
      if (!next_is(')')) throw TextError(at_, message::expected_in_unit("\")\" to close the unit"));
      ++at_;
    } else {
      unit = name();
    }
    return raised(unit, start);
  }

  Unit name() {
    if (next_is('1') || next_is('%')) return *find_unit(text_.substr(at_++, 1));
    const std::string_view found = peek_name();
    if (found.empty()) throw TextError(at_, message::expected_in_unit("the name of a unit"));
    const auto unit = find_unit(found);
    if (!unit) throw TextError(at_, message::unknown_unit(std::string(found)));
    at_ += found.size();
    return *unit;
  }

  Unit raised(const Unit& base, std::size_t start) {
    const std::size_t before = at_;
    skip_space();
    if (!next_is('^')) return at_ = before, base;
    ++at_;
    skip_space();
    int exponent = 0;
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), exponent);
    if (error != std::errc() || std::abs(exponent) > 99)
      throw TextError(at_, message::expected_in_unit("a whole exponent"));
    at_ = static_cast<std::size_t>(end - text_.data());
    if (base.offset != 0.0) throw TextError(start, message::celsius_in_compound());
    const auto dimension = power(base.dimension, exponent);
    if (!dimension) throw TextError(start, message::exponent_too_large());
    Unit unit{std::pow(base.factor, exponent), std::nullopt, *dimension, 0.0, base.hertz && exponent == 1};
    if (base.exact) unit.exact = exact_power(*base.exact, exponent);
    if (unit.exact) unit.factor = unit.exact->value();
    return unit;
  }

  static std::optional<Rational> exact_power(const Rational& base, int exponent) {
    std::optional<Rational> result(1);
    for (int k = 0; k < std::abs(exponent) && result; ++k) {
      result = exponent > 0 ? multiply(*result, base) : divide(*result, base);
    }
    return result;
  }

  static Unit combined(const Unit& a, const Unit& b, bool times, std::size_t start) {
    if (a.offset != 0.0 || b.offset != 0.0) throw TextError(start, message::celsius_in_compound());
    const auto dimension = times ? multiply(a.dimension, b.dimension) : divide(a.dimension, b.dimension);
    if (!dimension) throw TextError(start, message::exponent_too_large());
    Unit unit{times ? a.factor * b.factor : a.factor / b.factor, std::nullopt, *dimension, 0.0, false};
    if (a.exact && b.exact) unit.exact = times ? multiply(*a.exact, *b.exact) : divide(*a.exact, *b.exact);
    if (unit.exact) unit.factor = unit.exact->value();
    return unit;
  }

  std::string_view text_;
  std::size_t at_;
  const std::function<bool(std::string_view)>* ends_at_;  // nullptr: the text is a unit as a whole
};

}  // namespace

Unit parse_unit(std::string_view text) {
  UnitParser parser(text, 0, nullptr);
  const Unit unit = parser.product(0);
  if (!parser.done()) throw TextError(parser.at(), message::expected_in_unit("*, / or ^ between units"));
  return unit;
}

std::optional<Unit> parse_unit_in(std::string_view text, std::size_t& at,
                                  const std::function<bool(std::string_view)>& ends_at) {
  UnitParser parser(text, at, &ends_at);
  if (!parser.unit_follows(0) && !parser.reciprocal_follows()) return std::nullopt;
  const Unit unit = parser.product(0);
  at = parser.at();
  return unit;
}

const std::vector<std::string>& unit_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all{"kg", "mm", "cm", "km", "ms", "mV", "kW", "mA"};
    for (const NamedUnit& unit : table()) all.emplace_back(unit.name);
    return all;
  }();
  return names;
}

}  // namespace flyball
