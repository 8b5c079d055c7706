#include "models/difference.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "models/port_element.h"

namespace flyball {
namespace {

using Kind = Difference::Kind;

/// A value as it would be written on one line.
std::string written(const TomlValue& value) {
  const auto joined = [](const auto& all, auto&& one) {
    std::string text;
    for (const auto& each : all) text += (text.empty() ? "" : ", ") + one(each);
    return text;
  };
  switch (value.kind) {
    case TomlValue::Kind::boolean:
      return value.flag ? "true" : "false";
    case TomlValue::Kind::integer:
      return std::to_string(value.integer);
    case TomlValue::Kind::list:
      return '[' + joined(value.items, written) + ']';
    case TomlValue::Kind::table:
      return "{ " +
             joined(value.entries, [](const TomlEntry& e) { return e.key + " = " + written(e.value); }) +
             " }";
    case TomlValue::Kind::string:
      return '"' + value.text + '"';
    default:
      return value.text;
  }
}

/// Blanks say nothing in expressions and wires.
std::string without_blanks(std::string text) {
  std::erase_if(text, [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; });
  return text;
}

bool says_the_same(const TomlValue& a, const TomlValue& b) {
  if (a.numeric() && b.numeric()) return a.number == b.number;
  return without_blanks(written(a)) == without_blanks(written(b));
}

/// The numbers of a model by name: two literals of one value are equal, whatever their units.
class Numbers {
 public:
  explicit Numbers(const Diagram& diagram) {
    for (const Parameter& parameter : diagram.parameters) {
      note("parameters", parameter.name, parameter.binding);
      note("parameters", parameter.name + ".value", parameter.binding);
    }
    for (const Instance& instance : diagram.instances) {
      for (const auto& [slot, binding] : instance.parameters)
        note("blocks", instance.name + '.' + instance.object->specification->slots[slot].name, binding);
    }
  }

  const double* find(const std::string& section, const std::string& name) const {
    const auto found = values_.find({section, name});
    return found == values_.end() ? nullptr : &found->second;
  }

 private:
  void note(const std::string& section, const std::string& name, const Binding& binding) {
    if (binding.kind == Binding::Kind::literal) values_[{section, name}] = binding.value;
  }

  std::map<std::pair<std::string, std::string>, double> values_;
};

class Comparison {
 public:
  Comparison(const ComparedModel& before, const ComparedModel& after)
      : before_(before), after_(after), numbers_before_(before.diagram), numbers_after_(after.diagram) {}

  std::vector<Difference> run() {
    for (const TomlEntry& section : before_.text.entries) {
      if (section.key != "diagram") compare_section(section.key);
    }
    for (const TomlEntry& section : after_.text.entries) {
      if (section.key != "diagram" && before_.text.find(section.key) == nullptr) compare_section(section.key);
    }
    compare_inside();
    compare_sets("wires", wires(before_.diagram), wires(after_.diagram));
    compare_sets("log", logged(before_.diagram), logged(after_.diagram));
    return std::move(found_);
  }

 private:
  void compare_section(const std::string& key) {
    static const TomlValue nothing;
    section_ = key;
    const TomlValue* a = before_.text.find(key);
    const TomlValue* b = after_.text.find(key);
    if (a != nullptr && b != nullptr && !(a->is(TomlValue::Kind::table) && b->is(TomlValue::Kind::table)))
      return compare_values(key, *a, *b);
    compare_tables("", a == nullptr ? nothing : *a, b == nullptr ? nothing : *b);
  }

  void compare_tables(const std::string& prefix, const TomlValue& a, const TomlValue& b) {
    for (const TomlEntry& entry : a.entries) {
      const std::string name = prefix + entry.key;
      if (const TomlValue* other = b.find(entry.key)) {
        compare_values(name, entry.value, *other);
      } else {
        found_.push_back({Kind::removed, section_, name, written(entry.value), ""});
      }
    }
    for (const TomlEntry& entry : b.entries) {
      if (a.find(entry.key) == nullptr)
        found_.push_back({Kind::added, section_, prefix + entry.key, "", written(entry.value)});
    }
  }

  void compare_values(const std::string& name, const TomlValue& a, const TomlValue& b) {
    if (a.is(TomlValue::Kind::table) && b.is(TomlValue::Kind::table)) return compare_tables(name + '.', a, b);
    const double* x = numbers_before_.find(section_, name);
    const double* y = numbers_after_.find(section_, name);
    if (says_the_same(a, b) || (x != nullptr && y != nullptr && *x == *y)) return;
    found_.push_back({Kind::changed, section_, name, written(a), written(b)});
  }

  /// Blocks inside subsystems, which may stand in other files: dotted names.
  void compare_inside() {
    const auto before = inside(before_.diagram), after = inside(after_.diagram);
    for (const auto& [name, text] : before) {
      const auto other = after.find(name);
      if (other == after.end()) {
        found_.push_back({Kind::removed, "inside", name, text, ""});
      } else if (other->second != text) {
        found_.push_back({Kind::changed, "inside", name, text, other->second});
      }
    }
    for (const auto& [name, text] : after) {
      if (!before.contains(name)) found_.push_back({Kind::added, "inside", name, "", text});
    }
  }

  static std::map<std::string, std::string> inside(const Diagram& diagram) {
    std::map<std::string, std::string> result;
    for (const Instance& instance : diagram.instances) {
      if (instance.name.find('.') == std::string::npos) continue;
      result[instance.name] = instance.object->type->name;
      for (const auto& [slot, binding] : instance.parameters) {
        const std::string name = instance.name + '.' + instance.object->specification->slots[slot].name;
        result[name] = text_of(binding, diagram);
      }
    }
    return result;
  }

  static std::string text_of(const Binding& binding, const Diagram& diagram) {
    switch (binding.kind) {
      case Binding::Kind::parameter:
        return diagram.parameters[binding.parameter].name;
      case Binding::Kind::formula:
        return binding.formula->text;
      default:
        return fmt::format("{}", binding.value);
    }
  }

  using Names = std::vector<std::string>;

  static std::string end(const Diagram& diagram, bool is_input, int instance, int slot) {
    const Instance& of = diagram.instances[instance];
    return of.name + '.' + port_element(*of.object->specification, is_input, slot);
  }

  static Names wires(const Diagram& diagram) {
    Names result;
    for (int to = 0; to < static_cast<int>(diagram.instances.size()); ++to) {
      for (const auto& [slot, from] : diagram.instances[to].inputs) {
        if (!from.connected()) continue;
        result.push_back(end(diagram, false, from.instance, from.slot) + " -> " +
                         end(diagram, true, to, slot));
      }
    }
    return result;
  }

  static Names logged(const Diagram& diagram) {
    Names result;
    for (const Logged& signal : diagram.logged) result.push_back(signal.name);
    return result;
  }

  void compare_sets(const std::string& section, const Names& before, const Names& after) {
    const std::set<std::string> old(before.begin(), before.end()), now(after.begin(), after.end());
    for (const std::string& name : before) {
      if (!now.contains(name)) found_.push_back({Kind::removed, section, name, "", ""});
    }
    for (const std::string& name : after) {
      if (!old.contains(name)) found_.push_back({Kind::added, section, name, "", ""});
    }
  }

  const ComparedModel& before_;
  const ComparedModel& after_;
  Numbers numbers_before_, numbers_after_;
  std::string section_;
  std::vector<Difference> found_;
};

}  // namespace

std::vector<Difference> compare(const ComparedModel& before, const ComparedModel& after) {
  return Comparison(before, after).run();
}

}  // namespace flyball
