#include "tools/reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "studies/table.h"

namespace flyball {
namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string escaped(std::string_view cell) {
  std::string text;
  for (const char c : cell) text += c == '|' ? std::string("\\|") : std::string(1, c);
  return text;
}

/// A section with a table; nothing without rows.
std::string section(std::string_view title, const std::vector<std::string>& header, const Rows& rows) {
  if (rows.empty()) return {};
  std::string text = fmt::format("\n## {}\n\n| {} |\n|", title, fmt::join(header, " | "));
  for (std::size_t k = 0; k < header.size(); ++k) text += " --- |";
  text += '\n';
  for (const auto& row : rows) {
    text += '|';
    for (const std::string& cell : row) text += ' ' + escaped(cell) + " |";
    text += '\n';
  }
  return text;
}

std::string code(std::string_view text) { return fmt::format("`{}`", text); }

const char* to_text(Direction direction) {
  switch (direction) {
    case Direction::rising:
      return "rising";
    case Direction::falling:
      return "falling";
    case Direction::either:
      return "either";
  }
  return "";
}

/// One block with the names of its slots.
class Page {
 public:
  explicit Page(const BlockType& type) : type_(type), object_(type.create()), spec_(*object_.specification) {}

  std::string text() const {
    std::string page = fmt::format("# {}\n\n{}\n\nFamily: {}.", type_.name, type_.summary, type_.family);
    if (spec_.sampled()) page += " Sampled: evaluated at its hits, latched between.";
    if (!type_.differentiable) page += " Runs on numbers alone: contributes no derivative.";
    page += '\n';
    if (!type_.aliases.empty())
      page += fmt::format("\nAlso accepted as: `{}`.\n", fmt::join(type_.aliases, "`, `"));
    page += section("Structure", {"key", "default", "choices", "meaning"}, structure());
    page += section("Parameters", {"name", "unit", "default", "range", "meaning"}, parameters());
    page += section("Inputs", {"port", "unit", "elements", "unconnected", "meaning"}, ports(true));
    page += section("Outputs", {"port", "unit", "elements", "is", "meaning"}, ports(false));
    page += section("States", {"name", "unit", "initial", "meaning"}, states(SlotKind::state));
    page += section("Held values", {"name", "unit", "initial", "meaning"}, states(SlotKind::held));
    page += section("Relations", {"name", "on while positive"}, named(SlotKind::relation));
    page += section("Crossings", {"name", "direction", "fires when"}, crossings());
    page += section("Alarms", {"name", "due when"}, named(SlotKind::alarm));
    page += section("What reads what", {"result", "reads"}, reads());
    return page;
  }

 private:
  static std::string marked(const SlotSpec& slot, bool absent) {
    return absent ? slot.doc + " (only with other structure)" : slot.doc;
  }

  /// Calls `add(slot, absent)` for all that is declared of a kind, here or with other structure.
  void each(SlotKind kind, auto&& add) const {
    for (const SlotSpec& slot : spec_.slots) {
      if (slot.kind == kind && !slot.fixed) add(slot, false);
    }
    for (const SlotSpec& slot : spec_.absent) {
      if (slot.kind == kind) add(slot, true);
    }
  }

  Rows structure() const {
    Rows rows;
    for (const StructureSpec& key : spec_.structure) {
      rows.push_back(
          {code(key.key), code(key.fallback), fmt::format("{}", fmt::join(key.choices, ", ")), key.doc});
    }
    return rows;
  }

  Rows parameters() const {
    Rows rows;
    each(SlotKind::param, [&](const SlotSpec& s, bool absent) {
      rows.push_back(
          {code(s.name), s.unit, fmt::format("{}", s.fallback), to_string(s.range), marked(s, absent)});
    });
    return rows;
  }

  Rows ports(bool inputs) const {
    Rows rows;
    for (const PortSpec& port : spec_.ports) {
      if (port.is_input != inputs) continue;
      const SlotSpec& first = spec_.slots[static_cast<std::size_t>(port.slots[0])];
      const std::string last = inputs ? unconnected(first) : alias(port);
      rows.push_back(
          {code(port.name), units(port), fmt::format("{}", fmt::join(port.elements, ", ")), last, port.doc});
    }
    each(inputs ? SlotKind::input : SlotKind::output, [&](const SlotSpec& s, bool absent) {
      if (absent) rows.push_back({code(s.name), s.unit, "", "", marked(s, true)});
    });
    return rows;
  }

  std::string units(const PortSpec& port) const {
    std::vector<std::string> all;
    for (const int slot : port.slots) all.push_back(spec_.slots[static_cast<std::size_t>(slot)].unit);
    if (std::ranges::adjacent_find(all, std::not_equal_to<>()) == all.end()) all.resize(1);
    return all[0].empty() ? "object" : fmt::format("{}", fmt::join(all, ", "));
  }

  static std::string unconnected(const SlotSpec& slot) {
    return slot.optional ? fmt::format("{}", slot.fallback) : "not allowed";
  }

  std::string alias(const PortSpec& port) const {
    const SlotSpec& slot = spec_.slots[static_cast<std::size_t>(port.slots[0])];
    if (slot.kind == SlotKind::state || slot.kind == SlotKind::held)
      return fmt::format("{} {}", slot.kind == SlotKind::state ? "state" : "held value", code(slot.name));
    const auto passed = std::ranges::find(spec_.passed, port.slots[0], &PassThrough::output);
    return passed == spec_.passed.end() ? "computed" : fmt::format("input {}", code(name(passed->input)));
  }

  Rows states(SlotKind kind) const {
    Rows rows;
    each(kind, [&](const SlotSpec& s, bool absent) {
      const std::string initial =
          s.initial_param >= 0 ? code(name(s.initial_param)) : fmt::format("{}", s.fallback);
      rows.push_back({code(s.name), s.unit, initial, marked(s, absent)});
    });
    return rows;
  }

  Rows named(SlotKind kind) const {
    Rows rows;
    each(kind, [&](const SlotSpec& s, bool absent) { rows.push_back({code(s.name), marked(s, absent)}); });
    return rows;
  }

  Rows crossings() const {
    Rows rows;
    each(SlotKind::crossing, [&](const SlotSpec& s, bool absent) {
      rows.push_back({code(s.name), to_text(s.direction), marked(s, absent)});
    });
    return rows;
  }

  Rows reads() const {
    Rows rows;
    for (std::size_t s = 0; s < spec_.slots.size(); ++s) {
      const SlotSpec& slot = spec_.slots[s];
      if (!object_.reads[s].empty()) rows.push_back({code(slot.name), names(object_.reads[s])});
      if (slot.kind == SlotKind::state)
        rows.push_back({"rate of " + code(slot.name), names(object_.rate_reads[s])});
    }
    return rows;
  }

  std::string names(const std::vector<int>& slots) const {
    std::vector<std::string> all;
    for (const int slot : slots) all.push_back(code(name(slot)));
    return all.empty() ? "nothing" : fmt::format("{}", fmt::join(all, ", "));
  }

  std::string name(int slot) const {
    return slot == 0 ? "time" : spec_.slots[static_cast<std::size_t>(slot)].name;
  }

  const BlockType& type_;
  BlockObject object_;
  const Specification& spec_;
};

/// Families in the order of the catalogue, each with its blocks.
std::vector<std::pair<std::string, std::vector<const BlockType*>>> families() {
  std::vector<std::pair<std::string, std::vector<const BlockType*>>> all;
  for (const BlockType& type : catalogue()) {
    auto family = std::ranges::find(all, type.family, [](const auto& entry) { return entry.first; });
    if (family == all.end()) family = all.insert(all.end(), {type.family, {}});
    family->second.push_back(&type);
  }
  return all;
}

}  // namespace

std::string to_string(const Range& range) {
  const bool low = std::isfinite(range.lower), high = std::isfinite(range.upper);
  if (!low && !high) return "any";
  if (!high) return fmt::format("{} {}", range.lower_open ? ">" : ">=", range.lower);
  if (!low) return fmt::format("{} {}", range.upper_open ? "<" : "<=", range.upper);
  return fmt::format("{}{}, {}{}", range.lower_open ? '(' : '[', range.lower, range.upper,
                     range.upper_open ? ')' : ']');
}

std::string reference_page(const BlockType& type) { return Page(type).text(); }

std::string reference_index() {
  std::string text =
      "# Block reference\n\nMade by `flyball blocks --markdown` from the declarations of the blocks.\n";
  for (const auto& [family, types] : families()) {
    Rows rows;
    for (const BlockType* type : types)
      rows.push_back({fmt::format("[{0}]({0}.md)", type->name), type->summary});
    text += section(family, {"block", "summary"}, rows);
  }
  return text;
}

std::string block_list() {
  Table table({"block", "summary"});
  for (const auto& [family, types] : families()) {
    table.row({family});
    for (const BlockType* type : types) table.row({"  " + type->name, type->summary});
  }
  return table.text();
}

}  // namespace flyball
