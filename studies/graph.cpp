#include "studies/graph.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "studies/file.h"
#include "studies/process.h"
#include "studies/table.h"

namespace flyball {
namespace {

namespace fs = std::filesystem;

// Pale, so that black text stands out; neighbours in the catalogue differ most.
constexpr const char* fills[] = {"#fff2b3", "#cfe8ff", "#d5f0d0", "#fbd9c6", "#e6dbf5",
                                 "#e8e8e8", "#ffd6e0", "#d2f0ee", "#f0e4c8", "#dde5c2"};
// Of sample rates, the fastest first; dark enough for thin lines.
constexpr const char* rate_colours[] = {"#d62728", "#1f77b4", "#2ca02c", "#9467bd", "#ff7f0e", "#8c564b"};
constexpr const char* continuous_colour = "#333333";

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

/// A time with the unit that leaves few zeros.
std::string time_text(const Rational& time) {
  const double t = time.value();
  if (t == 0.0 || t >= 1.0) return fmt::format("{:.6g} s", t);
  return t >= 1e-3 ? fmt::format("{:.6g} ms", t * 1e3) : fmt::format("{:.6g} us", t * 1e6);
}

std::string rate_text(const Rate& rate) {
  const std::string period = time_text(rate.period);
  return rate.offset == Rational(0) ? period : fmt::format("{} + {}", period, time_text(rate.offset));
}

class GraphWriter {
 public:
  explicit GraphWriter(const Plan& plan) : plan_(plan), diagram_(*plan.diagram) {
    std::vector<int> fastest_first;
    for (std::size_t r = 0; r < plan.hit_rates.size(); ++r) fastest_first.push_back(static_cast<int>(r));
    std::ranges::stable_sort(fastest_first, {}, [&](int r) { return plan.hit_rates[r].period.value(); });
    rate_colour_.resize(plan.hit_rates.size());
    for (std::size_t k = 0; k < fastest_first.size(); ++k)
      rate_colour_[fastest_first[k]] = rate_colours[k % std::size(rate_colours)];
    for (const BlockType& type : catalogue())
      fill_of_family_.emplace(type.family, fills[fill_of_family_.size() % std::size(fills)]);
  }

  std::string text() {
    text_ =
        "digraph diagram {\n"
        "  graph [rankdir=LR, nodesep=0.3, ranksep=0.55, fontname=\"DejaVu Sans\", fontsize=12, "
        "labelloc=t, compound=true];\n"
        "  node [shape=plain, fontname=\"DejaVu Sans\", fontsize=10];\n"
        "  edge [fontname=\"DejaVu Sans\", fontsize=8, arrowsize=0.7, labeldistance=1.5];\n";
    if (!diagram_.title.empty()) text_ += fmt::format("  label=<<b>{}</b>>;\n", escaped(diagram_.title));
    std::vector<int> all(diagram_.instances.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
    write_level(all, "", 1);
    write_wires();
    write_legend();
    return text_ + "}\n";
  }

 private:
  const Specification& spec(int i) const { return *diagram_.instances[i].object->specification; }
  const std::string& family(int i) const { return diagram_.instances[i].object->type->family; }
  std::string colour(int i) const {
    return plan_.rate_of[i] < 0 ? continuous_colour : rate_colour_[plan_.rate_of[i]];
  }

  /// The blocks of a subsystem, whose names begin with `prefix`; a box around each subsystem inside.
  void write_level(const std::vector<int>& instances, const std::string& prefix, int depth) {
    const std::string indent(2 * static_cast<std::size_t>(depth), ' ');
    std::vector<std::pair<std::string, std::vector<int>>> inside;
    for (const int i : instances) {
      const std::string& name = diagram_.instances[i].name;
      const std::size_t dot = name.find('.', prefix.size());
      if (dot == std::string::npos) {
        text_ += indent + node(i, name.substr(prefix.size()));
        continue;
      }
      const std::string part = name.substr(prefix.size(), dot - prefix.size());
      auto found = std::ranges::find(inside, part, &std::pair<std::string, std::vector<int>>::first);
      if (found == inside.end()) found = inside.insert(found, {part, {}});
      found->second.push_back(i);
    }
    for (const auto& [part, members] : inside) {
      text_ += fmt::format(
          "{0}subgraph \"cluster {1}{2}\" {{\n{0}  label=<{3}>; style=\"rounded,filled\"; "
          "color=\"#888888\"; fillcolor=\"#00000008\";\n",
          indent, prefix, part, escaped(part));
      write_level(members, prefix + part + '.', depth + 1);
      text_ += indent + "}\n";
    }
  }

  std::string node(int i, const std::string& shown) const {
    std::string rows =
        fmt::format("<tr><td><b>{}</b></td></tr><tr><td><font point-size=\"8\">{}</font></td></tr>",
                    escaped(shown), escaped(diagram_.instances[i].object->type->name));
    for (const std::string& setting : settings(i))
      rows += fmt::format("<tr><td><font point-size=\"8\" color=\"#555555\">{}</font></td></tr>",
                          escaped(setting));
    return fmt::format(
        "n{} [label=<<table border=\"{}\" color=\"{}\" cellborder=\"0\" cellspacing=\"0\" "
        "cellpadding=\"3\" style=\"rounded\" bgcolor=\"{}\">{}</table>>, tooltip=\"{}\"];\n",
        i, plan_.rate_of[i] < 0 ? 1 : 2, colour(i), fill_of_family_.at(family(i)), rows,
        escaped(rate_name(plan_, i)));
  }

  /// The few parameters that the model gave: what a reader wants to see on the block.
  std::vector<std::string> settings(int i) const {
    constexpr std::size_t most = 3, longest = 24;
    std::vector<std::string> lines;
    for (const auto& [slot, binding] : diagram_.instances[i].parameters) {
      const SlotSpec& parameter = spec(i).slots[slot];
      if (parameter.fixed || !parameter.reference.empty()) continue;
      const bool is_default = binding.kind == Binding::Kind::literal && binding.value == parameter.fallback;
      if (is_default) continue;
      std::string line = fmt::format("{} = {}", parameter.name, value_text(binding));
      if (line.size() > longest) line = line.substr(0, longest) + "…";
      lines.push_back(std::move(line));
    }
    if (lines.size() > most) {
      lines.resize(most);
      lines.push_back("…");
    }
    return lines;
  }

  std::string value_text(const Binding& binding) const {
    switch (binding.kind) {
      case Binding::Kind::parameter:
        return diagram_.parameters[binding.parameter].name;
      case Binding::Kind::formula:
        return binding.formula->text;
      default:
        return fmt::format("{:.5g}", binding.value);
    }
  }

  /// One line a pair of ports, however many elements it carries.
  void write_wires() {
    for (int to = 0; to < static_cast<int>(diagram_.instances.size()); ++to) {
      std::set<std::tuple<int, const PortSpec*, const PortSpec*>> seen;
      for (const auto& [slot, from] : diagram_.instances[to].inputs) {
        if (!from.connected()) continue;
        const PortSpec* source = port_of(from.instance, from.slot);
        const PortSpec* target = port_of(to, slot);
        if (!seen.emplace(from.instance, source, target).second) continue;
        text_ += fmt::format("  n{} -> n{} [color=\"{}\"{}{}{}];\n", from.instance, to, colour(from.instance),
                             label("taillabel", from.instance, source), label("headlabel", to, target),
                             source != nullptr && source->slots.size() > 1 ? ", penwidth=2.2" : "");
      }
    }
  }

  const PortSpec* port_of(int i, int slot) const {
    for (const PortSpec& port : spec(i).ports) {
      if (std::ranges::find(port.slots, slot) != port.slots.end()) return &port;
    }
    return nullptr;
  }

  /// Where a block has several ports of a kind, the wire says which it means.
  std::string label(const char* end, int i, const PortSpec* port) const {
    if (port == nullptr) return {};
    const auto alike = std::ranges::count(spec(i).ports, port->is_input, &PortSpec::is_input);
    return alike < 2 ? std::string() : fmt::format(", {}=<{}>", end, escaped(port->name));
  }

  void write_legend() {
    std::string rows;
    std::set<std::string> families;
    for (std::size_t i = 0; i < diagram_.instances.size(); ++i) families.insert(family(static_cast<int>(i)));
    for (const BlockType& type : catalogue()) {
      if (families.erase(type.family) == 0) continue;
      rows += fmt::format("<tr><td bgcolor=\"{}\" align=\"left\">{}</td></tr>",
                          fill_of_family_.at(type.family), escaped(type.family));
    }
    for (std::size_t r = 0; r < plan_.hit_rates.size(); ++r) {
      rows += fmt::format("<tr><td align=\"left\"><font color=\"{}\">every {}</font></td></tr>",
                          rate_colour_[r], escaped(rate_text(plan_.hit_rates[r])));
    }
    text_ += fmt::format(
        "  legend [label=<<table border=\"0\" cellborder=\"0\" cellspacing=\"2\" "
        "cellpadding=\"2\">{}</table>>, fontsize=8];\n",
        rows);
  }

  const Plan& plan_;
  const Diagram& diagram_;
  std::vector<std::string> rate_colour_;
  std::map<std::string, std::string> fill_of_family_;
  std::string text_;
};

}  // namespace

std::string rate_name(const Plan& plan, int instance) {
  const int rate = plan.rate_of[instance];
  return rate < 0 ? "continuous" : rate_text(plan.hit_rates[rate]);
}

std::string graph_text(const Plan& plan) { return GraphWriter(plan).text(); }

std::vector<ExecutionStep> execution_order(const Plan& plan) {
  std::vector<ExecutionStep> steps;
  for (const Op& op : plan.sweep.ops) {
    for (int k = 0; k < op.count; ++k)
      steps.push_back({plan.placed[op.place + k], op.phase == Phase::relations ? "relations" : "outputs"});
  }
  return steps;
}

std::string order_table(const Plan& plan) {
  Table table({"step", "block", "type", "computes", "rate"});
  int number = 0;
  for (const ExecutionStep& step : execution_order(plan)) {
    const Instance& instance = plan.instance(step.instance);
    table.row({std::to_string(++number), instance.name, instance.object->type->name, step.computes,
               rate_name(plan, step.instance)});
  }
  return table.text();
}

Drawing draw_graph(const std::string& graph, const fs::path& figure, const std::string& format) {
  const TemporaryFile source(figure), part(figure);
  write_file(source.path(), graph);
  const fs::path folder = figure.has_parent_path() ? figure.parent_path() : ".";
  const int status = run_process({"dot", "-T" + format, "-o", "./" + part.path().filename().string(),
                                  "./" + source.path().filename().string()},
                                 folder);
  if (status == 0) {
    keep_drawing(part.path(), figure);
    return {true, {}};
  }
  const std::string why = status == -1 ? "Graphviz is not installed (Debian: apt-get install graphviz)"
                                       : fmt::format("Graphviz' dot ended with status {}", status);
  return {false, fmt::format("{}: not drawn: {}", figure.string(), why)};
}

}  // namespace flyball
