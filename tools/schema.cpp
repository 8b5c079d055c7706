#include "tools/schema.h"

#include <fmt/format.h>

#include <cctype>
#include <nlohmann/json.hpp>

#include "blocks/registry.h"
#include "solvers/stepper.h"

namespace flyball {
namespace {

using Json = nlohmann::ordered_json;

/// A number, or an expression with units in quotes.
Json quantity(const std::string& doc) { return {{"type", {"number", "string"}}, {"description", doc}}; }

Json text(const std::string& doc) { return {{"type", "string"}, {"description", doc}}; }

Json table(Json properties) {
  return {{"type", "object"}, {"properties", std::move(properties)}, {"additionalProperties", false}};
}

Json list_of(Json items) { return {{"type", "array"}, {"items", std::move(items)}}; }

std::string described(const SlotSpec& slot) {
  return slot.unit == "any" ? slot.doc : fmt::format("{} [{}]", slot.doc, slot.unit);
}

Json parameter(const SlotSpec& slot) {
  if (slot.entry >= 0) return {{"type", "array"}, {"description", described(slot)}};
  Json json = quantity(described(slot));
  json["default"] = slot.fallback;
  return json;
}

/// What may stand for a key that fixes the shape, judged by how its default is written.
Json structure(const StructureSpec& key) {
  Json json = {{"description", key.doc}};
  if (!key.choices.empty()) {
    json["enum"] = key.choices;
  } else if (key.fallback == "true" || key.fallback == "false") {
    json["type"] = "boolean";
  } else if (key.fallback.starts_with('[')) {
    json["type"] = "array";
  }
  return json;
}

Json block(const BlockType& type) {
  const BlockObject object = type.create();
  Json names = {type.name};
  for (const std::string& alias : type.aliases) names.push_back(alias);
  Json properties = {{"type", {{"enum", names}, {"description", type.summary}}}};
  const auto add = [&](const SlotSpec& slot) {
    const bool settable = slot.kind == SlotKind::param && !slot.fixed && slot.reference.empty();
    if (settable && !properties.contains(slot.setting)) properties[slot.setting] = parameter(slot);
  };
  for (const StructureSpec& key : object.specification->structure) properties[key.key] = structure(key);
  for (const SlotSpec& slot : object.specification->slots) add(slot);
  for (const SlotSpec& slot : object.specification->absent) add(slot);
  Json json = table(std::move(properties));
  json["title"] = type.name;
  json["description"] = type.summary;
  json["required"] = {"type"};
  return json;
}

/// A block is one of the catalogue, or a subsystem, of which the catalogue knows nothing.
Json any_block() {
  Json alternatives = Json::array();
  for (const BlockType& type : catalogue()) alternatives.push_back({{"$ref", "#/definitions/" + type.name}});
  alternatives.push_back({{"$ref", "#/definitions/subsystem instance"}});
  return {{"oneOf", alternatives}};
}

Json subsystem_instance() {
  Json type = {{"type", "string"},
               {"description", "a name of [subsystems], or a model file with [ports]"},
               {"not", {{"enum", block_type_names()}}}};
  return {{"type", "object"}, {"properties", {{"type", type}}}, {"required", {"type"}}};
}

Json parameter_declaration() {
  Json full = table({{"value", quantity("the number, or an expression over other parameters")},
                     {"unit", text("its unit, where the value has none")},
                     {"range", list_of(quantity("an end of the range"))},
                     {"doc", text("what it is")}});
  return {{"anyOf", {{{"type", {"number", "string"}}}, full}}};
}

Json simulation() {
  std::vector<std::string> methods = stepper_methods();
  methods.insert(methods.begin(), "auto");
  Json solver = {{"type", "object"},
                 {"properties",
                  {{"method", {{"enum", methods}, {"description", "method of integration"}}},
                   {"rtol", quantity("relative tolerance")},
                   {"atol", quantity("absolute tolerance")},
                   {"max_step", quantity("longest step of a variable-step method [s]")},
                   {"step", quantity("step of a fixed-step method [s]")}}}};
  return {{"type", "object"},
          {"properties",
           {{"stop", quantity("end of the run [s]")},
            {"log_interval", quantity("time between rows [s]")},
            {"solver", std::move(solver)}}}};
}

}  // namespace

std::string model_schema() {
  const Json anything = {{"type", "object"}};
  const Json blocks = {{"type", "object"}, {"additionalProperties", {{"$ref", "#/definitions/block"}}}};
  Json definitions = {{"block", any_block()}, {"subsystem instance", subsystem_instance()}};
  for (const BlockType& type : catalogue()) definitions[type.name] = block(type);
  Json properties = {
      {"flyball", {{"enum", {1}}, {"description", "version of the file format"}}},
      {"model", table({{"title", text("what it is")}, {"source", text("where it was published")}})},
      {"ports", anything},
      {"parameters", {{"type", "object"}, {"additionalProperties", parameter_declaration()}}},
      {"subsystems", {{"type", "object"}, {"additionalProperties", anything}}},
      {"blocks", blocks},
      {"diagram", table({{"wires", list_of(text("such as \"a -> b.port\""))},
                         {"log", list_of(text("a signal to record"))}})},
      {"simulation", simulation()},
      {"metrics", {{"type", "object"}, {"additionalProperties", text("such as \"settling(y, 2 %)\"")}}},
      {"requirements", {{"type", "object"}, {"additionalProperties", text("such as \"max(y) < 5 V\"")}}}};
  Json schema = table(std::move(properties));
  schema["required"] = {"flyball", "blocks"};
  Json json = {{"$schema", "http://json-schema.org/draft-04/schema#"}, {"title", "Flyball model"}};
  json.update(schema);
  json["definitions"] = std::move(definitions);
  return json.dump(2) + '\n';
}

}  // namespace flyball
