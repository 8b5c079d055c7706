#include "tools/json.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "models/dimensions.h"
#include "models/port_element.h"
#include "studies/graph.h"

namespace flyball {
namespace {

using Json = nlohmann::ordered_json;

std::string text_of(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

const char* name_of(Diagnostic::Severity severity) {
  switch (severity) {
    case Diagnostic::Severity::error:
      return "error";
    case Diagnostic::Severity::warning:
      return "warning";
    case Diagnostic::Severity::note:
      return "note";
  }
  return "";
}

Json diagnostic_json(const Diagnostic& d) {
  return {{"severity", name_of(d.severity)},
          {"file", d.file},
          {"line", d.at.line},
          {"column", d.at.column},
          {"message", d.message}};
}

Json diagnostics_json(const std::vector<Diagnostic>& diagnostics) {
  Json json = Json::array();
  for (const Diagnostic& d : diagnostics) json.push_back(diagnostic_json(d));
  return json;
}

Json result_json(const ResultCheck& result) {
  return {{"file", result.file},
          {"ok", result.ok()},
          {"rows", result.rows},
          {"columns", result.columns},
          {"diagnostics", diagnostics_json(result.diagnostics)}};
}

Json study_json(const CheckedStudy& study) {
  return {{"file", study.name},
          {"ok", count_errors(study.diagnostics) == 0},
          {"runs", study.runs},
          {"diagnostics", diagnostics_json(study.diagnostics)}};
}

/// A unit that the model does not determine is null.
Json units_json(const std::vector<NamedUnit>& units) {
  Json json = Json::array();
  for (const auto& [name, unit] : units) {
    json.push_back({{"name", name}, {"unit", unit.empty() ? Json(nullptr) : Json(unit)}});
  }
  return json;
}

Json model_json(const ModelFile& model, bool units) {
  Json json = {{"file", model.name}, {"ok", model.plan != nullptr}};
  if (model.plan) {
    const Plan& plan = *model.plan;
    json["blocks"] = plan.diagram->instances.size();
    json["states"] = plan.layout.states();
    json["rates"] = plan.hit_rates.size();
    json["crossings"] = plan.crossing_records.size() + plan.located_relations.size();
  }
  json["diagnostics"] = diagnostics_json(model.diagnostics);
  if (!units || !model.plan) return json;
  const DimensionTable table = dimension_table(*model.plan->diagram);
  json["signals"] = units_json(table.signals);
  json["parameters"] = units_json(table.parameters);
  json["notes"] = diagnostics_json(table.notes);
  return json;
}

/// JSON has no infinity: a missing end is null.
Json end_json(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

Json slot_json(const SlotSpec& slot) {
  Json json = {{"name", slot.name}, {"unit", slot.unit}, {"doc", slot.doc}};
  if (slot.kind == SlotKind::param) {
    json["default"] = slot.fallback;
    json["range"] = {{"lower", end_json(slot.range.lower)},
                     {"upper", end_json(slot.range.upper)},
                     {"lower_open", slot.range.lower_open},
                     {"upper_open", slot.range.upper_open}};
  }
  if (slot.optional) json["default"] = slot.fallback;
  return json;
}

Json port_json(const Specification& spec, const PortSpec& port) {
  Json json = slot_json(spec.slots[static_cast<std::size_t>(port.slots[0])]);
  json["name"] = port.name;
  json["doc"] = port.doc;
  if (!port.elements.empty()) json["elements"] = port.elements;
  return json;
}

Json block_json(const BlockType& type) {
  const BlockObject object = type.create();
  const Specification& spec = *object.specification;
  Json json = {
      {"name", type.name}, {"family", type.family}, {"summary", type.summary}, {"aliases", type.aliases}};
  json["structure"] = Json::array();
  for (const StructureSpec& key : spec.structure) {
    json["structure"].push_back(
        {{"key", key.key}, {"default", key.fallback}, {"choices", key.choices}, {"doc", key.doc}});
  }
  for (const bool is_input : {true, false}) {
    Json& ports = json[is_input ? "inputs" : "outputs"] = Json::array();
    for (const PortSpec& port : spec.ports) {
      if (port.is_input == is_input) ports.push_back(port_json(spec, port));
    }
  }
  for (const auto& [key, kind] :
       {std::pair("parameters", SlotKind::param), std::pair("states", SlotKind::state),
        std::pair("held", SlotKind::held), std::pair("relations", SlotKind::relation),
        std::pair("crossings", SlotKind::crossing), std::pair("alarms", SlotKind::alarm)}) {
    Json& slots = json[key] = Json::array();
    for (const SlotSpec& slot : spec.slots) {
      if (slot.kind == kind && !slot.fixed) slots.push_back(slot_json(slot));
    }
  }
  return json;
}

}  // namespace

std::string check_json(const std::vector<ModelFile>& models, bool units,
                       const std::vector<ResultCheck>& results, const std::vector<CheckedStudy>& studies) {
  Json json = {{"models", Json::array()}};
  for (const ModelFile& model : models) json["models"].push_back(model_json(model, units));
  for (const ResultCheck& result : results) json["results"].push_back(result_json(result));
  for (const CheckedStudy& study : studies) json["studies"].push_back(study_json(study));
  return text_of(json);
}

std::string diff_json(const std::vector<Difference>& differences) {
  const auto kind = [](const Difference& d) {
    return d.kind == Difference::Kind::added     ? "added"
           : d.kind == Difference::Kind::removed ? "removed"
                                                 : "changed";
  };
  Json json = {{"differences", Json::array()}};
  for (const Difference& d : differences) {
    json["differences"].push_back({{"kind", kind(d)},
                                   {"section", d.section},
                                   {"name", d.name},
                                   {"before", d.before},
                                   {"after", d.after}});
  }
  return text_of(json);
}

std::string format_json(const std::vector<FormattedFile>& files) {
  Json json = {{"files", Json::array()}};
  for (const FormattedFile& file : files)
    json["files"].push_back({{"file", file.name}, {"changed", file.changed}});
  return text_of(json);
}

std::string graph_json(const Plan& plan) {
  Json json = {{"blocks", Json::array()}, {"wires", Json::array()}, {"order", Json::array()}};
  const auto& instances = plan.diagram->instances;
  for (std::size_t i = 0; i < instances.size(); ++i) {
    const BlockType& type = *instances[i].object->type;
    json["blocks"].push_back({{"name", instances[i].name},
                              {"type", type.name},
                              {"family", type.family},
                              {"rate", rate_name(plan, static_cast<int>(i))}});
  }
  const auto end = [&](bool is_input, int i, int slot) {
    return instances[i].name + '.' + port_element(*instances[i].object->specification, is_input, slot);
  };
  for (std::size_t i = 0; i < instances.size(); ++i) {
    for (const auto& [slot, from] : instances[i].inputs) {
      if (!from.connected()) continue;
      json["wires"].push_back(
          {{"from", end(false, from.instance, from.slot)}, {"to", end(true, static_cast<int>(i), slot)}});
    }
  }
  for (const ExecutionStep& step : execution_order(plan))
    json["order"].push_back({{"block", instances[step.instance].name}, {"computes", step.computes}});
  return text_of(json);
}

std::string blocks_json(const std::vector<const BlockType*>& types) {
  Json json = {{"blocks", Json::array()}};
  for (const BlockType* type : types) json["blocks"].push_back(block_json(*type));
  return text_of(json);
}

}  // namespace flyball
