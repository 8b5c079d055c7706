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
    // A list of one may be written as its value.
    json["type"] = {"array", "number", "string"};
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

Json words(const std::vector<std::string>& all, const std::string& doc) {
  return {{"enum", all}, {"description", doc}};
}

Json count(const std::string& doc) { return {{"type", "integer"}, {"minimum", 1}, {"description", doc}}; }

Json names(const std::string& doc) {
  Json json = list_of({{"type", "string"}});
  json["description"] = doc;
  return json;
}

/// A table whose keys are names of the user's.
Json each(Json value, const std::string& doc) {
  return {{"type", "object"}, {"additionalProperties", std::move(value)}, {"description", doc}};
}

Json reference_to(const std::string& definition) { return {{"$ref", "#/definitions/" + definition}}; }

/// Names of parameters have dots: without quotes they are tables in tables.
Json or_parts(Json value, const std::string& definition) {
  return {{"anyOf",
           {std::move(value), {{"type", "object"}, {"additionalProperties", reference_to(definition)}}}}};
}

Json study_head() {
  const Json file = text("model file, from the folder of the study");
  Json json =
      table({{"title", text("what the study is about")},
             {"model", file},
             {"models", {{"anyOf", {list_of(file), each(file, "model files by name")}}}},
             {"seed", {{"type", "integer"}, {"minimum", 0}, {"description", "of all random numbers"}}}});
  json["oneOf"] = {{{"required", {"model"}}}, {{"required", {"models"}}}};
  return json;
}

Json axis() {
  Json range = table({{"from", quantity("first value")},
                      {"to", quantity("last value")},
                      {"points", count("how many values")},
                      {"step", quantity("distance of the values, instead of points")},
                      {"scale", words({"linear", "log"}, "how the values are spread")}});
  range["required"] = {"from", "to"};
  Json values = list_of({{"type", {"number", "string", "boolean"}}});
  values["minItems"] = 1;
  return or_parts({{"anyOf", {std::move(values), std::move(range)}}}, "axis");
}

Json distribution() {
  const auto numbers = [](int least, int most, const std::string& doc) {
    Json json = list_of(quantity("a number"));
    json["minItems"] = least;
    if (most > 0) json["maxItems"] = most;
    json["description"] = doc;
    return json;
  };
  Json json = table({{"uniform", numbers(2, 2, "[lower, upper]")},
                     {"normal", numbers(2, 2, "[mean, standard deviation]")},
                     {"lognormal", numbers(2, 2, "[median, factor of one standard deviation]")},
                     {"triangular", numbers(3, 3, "[lower, most likely, upper]")},
                     {"choice", numbers(1, 0, "values of equal probability")},
                     {"within", numbers(2, 2, "[lower, upper] of a normal or lognormal one")}});
  json["minProperties"] = 1;
  return or_parts(std::move(json), "distribution");
}

/// Bounds of a parameter that is looked for.
Json sought() {
  const Json bounds = list_of(quantity("an end of the range"));
  Json full = table({{"range", bounds},
                     {"start", quantity("where the search begins")},
                     {"scale", quantity("its typical size")}});
  return or_parts({{"anyOf", {bounds, std::move(full)}}}, "sought");
}

Json fit() {
  Json match = each({{"type", {"string", "object"}}}, "column of the data by logged signal");
  Json experiment = table({{"name", text("of the experiment")},
                           {"data", text("CSV file, from the folder of the study")},
                           {"match", std::move(match)},
                           {"set", reference_to("settings")}});
  Json parameters = {
      {"anyOf", {names("parameters"), each(reference_to("sought"), "parameters with bounds")}}};
  return table({{"model", text("name of the one model that is fitted")},
                {"parameters", std::move(parameters)},
                {"experiments", list_of(std::move(experiment))},
                {"requirements", names("requirements that are residuals, too")},
                {"minimise", names("metrics that are residuals, too")},
                {"loss", words({"squared", "huber", "cauchy", "soft_l1"}, "what a residual costs")},
                {"loss_scale", quantity("residual at which a robust loss begins to yield")},
                {"starts", count("starting points")},
                {"gradient", words({"exact", "numeric"}, "how derivatives are found")},
                {"max_iterations", count("iterations from one start")}});
}

Json front() {
  const Json by_objective = each(quantity("a number"), "a number for each objective");
  return table({{"model", text("name of the one model that is optimised")},
                {"algorithm", words({"nsga2", "moead", "nspso", "mopso"}, "how the front is looked for")},
                {"evaluations", count("runs of the model")},
                {"population", count("points of a generation")},
                {"parameters", each(reference_to("sought"), "parameters with bounds")},
                {"minimise", names("metrics")},
                {"maximise", names("metrics")},
                {"requirements", names("requirements that must hold")},
                {"scenarios", names("scenarios over which objectives are averaged")},
                {"reference", by_objective},
                {"pick", {{"anyOf", {text("\"knee\", or an objective"), by_objective}}}}});
}

Json bisection() {
  Json json = table({{"model", text("name of the one model that is looked at")},
                     {"parameter", text("that is changed")},
                     {"between", list_of(quantity("an end of the range"))},
                     {"requirement", text("that holds at one end, and not at the other")},
                     {"tolerance", quantity("how exactly the value is wanted")}});
  json["required"] = {"parameter", "between", "requirement"};
  return json;
}

Json plot() {
  return table({{"title", text("over the figure")},
                {"signals", names("logged signals, or metrics over x")},
                {"x", text("a signal, a metric or an axis of [sweep]; without it, time")},
                {"by", words({"case", "scenario", "sweep", "model"}, "what has a curve each")},
                {"scenario", text("that is shown")}});
}

Json study_sections() {
  Json sweep = each(reference_to("axis"), "axes");
  sweep["properties"] = {{"combine", words({"product", "zip"}, "all combinations, or value by value")}};
  Json monte_carlo = each(reference_to("distribution"), "parameters with their distributions");
  monte_carlo["properties"] = {
      {"runs", count("samples")},
      {"sampling", words({"random", "latin_hypercube", "sobol"}, "how the samples are spread")}};
  monte_carlo["required"] = {"runs"};
  const Json one_text = {{"type", "string"}};
  return {{"flyball", {{"enum", {1}}, {"description", "version of the file format"}}},
          {"study", study_head()},
          {"cases", each(reference_to("settings"), "what is compared")},
          {"scenarios", each(reference_to("settings"), "where it is compared")},
          {"sweep", std::move(sweep)},
          {"monte_carlo", std::move(monte_carlo)},
          {"metrics", each(one_text, "numbers that sum up a run, such as \"overshoot(y)\"")},
          {"requirements", each(one_text, "what makes a run good, such as \"overshoot(y) < 5 %\"")},
          {"fit", each(fit(), "fits by name")},
          {"pareto", each(front(), "fronts by name")},
          {"bisect", each(bisection(), "limits of parameters by name")},
          {"plot", list_of(plot())}};
}

/// A schema of files of a kind, with their sections and what these refer to.
std::string schema_of(const std::string& title, Json sections, const std::vector<std::string>& required,
                      Json definitions) {
  Json schema = table(std::move(sections));
  schema["required"] = required;
  Json json = {{"$schema", "http://json-schema.org/draft-04/schema#"}, {"title", title}};
  json.update(schema);
  json["definitions"] = std::move(definitions);
  return json.dump(2) + '\n';
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
  return schema_of("Flyball model", std::move(properties), {"flyball", "blocks"}, std::move(definitions));
}

std::string study_schema() {
  const Json setting = {{"type", {"number", "string", "boolean", "object"}}};
  const Json definitions = {
      {"settings", each(setting, "values of parameters, of block.setting, of simulation.key")},
      {"axis", axis()},
      {"distribution", distribution()},
      {"sought", sought()}};
  return schema_of("Flyball study", study_sections(), {"flyball", "study"}, definitions);
}

}  // namespace flyball
