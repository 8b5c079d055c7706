#include "studies/metadata.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "blocks/hash.h"
#include "studies/versions.h"

namespace flyball {
namespace {

// Keys in the order in which they are written here: people read these files, too.
using Json = nlohmann::ordered_json;

Json model_of(const RunResult& result, const RunInputs& inputs) {
  const Diagram& diagram = *result.plan->diagram;
  Json model = {{"file", inputs.model_file}, {"title", diagram.title},
                {"source", diagram.source},  {"hash", model_fingerprint(inputs.model_text, diagram)},
                {"uses", Json::array()},     {"set", Json::object()}};
  for (const UsedFile& used : diagram.used_files)
    model["uses"].push_back({{"file", used.name}, {"hash", fingerprint(used.text)}});
  for (const DataFile& file : diagram.data_files) model["data"][file.name] = file.hash;
  for (const Override& value : inputs.overrides) model["set"][value.name] = value.value;
  return model;
}

Json solver_of(const RunResult& result) {
  const StepperStatistics& steps = result.statistics.stepper;
  return {{"method", result.method.method},
          {"asked", result.settings.method},
          {"reason", result.method.reason},
          {"rtol", result.settings.rtol},
          {"atol", result.settings.atol},
          {"max_step", result.max_step},
          {"statistics",
           {{"steps", steps.steps},
            {"rejected", steps.rejected},
            {"rate_evaluations", steps.rate_evaluations},
            {"jacobians", steps.jacobians},
            {"restarts", steps.restarts},
            {"hits", result.statistics.hits},
            {"alarms", result.statistics.alarms},
            {"events", result.statistics.events}}}};
}

Json columns_of(const Log& log) {
  Json columns = Json::array({{{"name", "time"}, {"unit", "s"}}});
  for (const LogColumn& column : log.columns()) {
    columns.push_back({{"name", column.name}, {"unit", column.unit == "any" ? "" : column.unit}});
  }
  return columns;
}

Json last_row_of(const Log& log) {
  Json row = Json::object();
  if (log.rows() == 0) return row;
  row["time"] = log.time(log.rows() - 1);
  for (int c = 0; c < log.width(); ++c) {
    row[log.columns()[static_cast<std::size_t>(c)].name] = log.value(log.rows() - 1, c);
  }
  return row;
}

/// A number that is not there is null.
Json metrics_of(const Assessment& assessment) {
  Json metrics = Json::object();
  for (const auto& [name, text, unit, value] : assessment.metrics)
    metrics[name] = {{"text", text}, {"value", value}, {"unit", unit}};
  return metrics;
}

Json requirements_of(const Assessment& assessment) {
  Json requirements = Json::object();
  for (const auto& [name, text, unit, verdict] : assessment.requirements) {
    requirements[name] = {{"text", text},
                          {"passed", verdict.passed},
                          {"margin", verdict.margin},
                          {"value", verdict.value},
                          {"time", verdict.time},
                          {"unit", unit},
                          {"message", verdict.message}};
  }
  return requirements;
}

constexpr std::string_view seal_begin = ",\n  \"metadata_checksum\": \"";

/// The end of a sidecar: the checksum of all that stands before it.
std::string seal_of(std::string_view text) {
  return fmt::format("{}{}\"\n}}\n", seal_begin, fingerprint(text));
}

/// Throws MetadataError unless the end of the text is the seal of what stands before it.
void require_seal(std::string_view json) {
  const std::size_t end = json.rfind(seal_begin);
  if (end == std::string_view::npos)
    throw MetadataError("truncated, or not the metadata of a result: there is no \"metadata_checksum\"");
  const std::string seal = seal_of(json.substr(0, end));
  if (json.substr(end) == seal) return;
  const auto checksum = [](std::string_view text) {
    text.remove_prefix(std::min(seal_begin.size(), text.size()));
    return text.substr(0, text.find('"'));
  };
  throw MetadataError(
      fmt::format("changed or truncated: its text has the checksum {}, \"metadata_checksum\" is {}",
                  checksum(seal), checksum(json.substr(end))));
}

void read_model(const Json& model, ResultFacts& facts) {
  facts.model_file = model.at("file");
  facts.model_hash = model.at("hash");
  facts.title = model.at("title");
  facts.source = model.at("source");
  for (const auto& [name, value] : model.at("set").items()) facts.overrides.push_back({name, value});
}

void read_solver(const Json& solver, ResultFacts& facts) {
  facts.method = solver.at("method");
  facts.asked_method = solver.at("asked");
  facts.rtol = solver.at("rtol");
  facts.atol = solver.at("atol");
  const std::string reason = solver.at("reason");
  facts.solver.emplace_back(
      "method", facts.asked_method == "auto" ? facts.method + " (auto: " + reason + ")" : facts.method);
  facts.solver.emplace_back("rtol", fmt::format("{:g}", facts.rtol));
  facts.solver.emplace_back("atol", fmt::format("{:g}", facts.atol));
  facts.solver.emplace_back("longest step", fmt::format("{:g} s", solver.at("max_step").get<double>()));
  for (const auto& [name, count] : solver.at("statistics").items()) {
    std::string words = name;
    std::ranges::replace(words, '_', ' ');
    facts.solver.emplace_back(words, std::to_string(count.get<long>()));
  }
}

/// NaN where there is no number.
double number_of(const Json& json) {
  return json.is_number() ? json.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

void read_assessment(const Json& json, Assessment& assessment) {
  const Json metrics = json.value("metrics", Json::object());
  const Json requirements = json.value("requirements", Json::object());
  for (const auto& [name, metric] : metrics.items())
    assessment.metrics.push_back({name, metric.at("text"), metric.at("unit"), number_of(metric.at("value"))});
  for (const auto& [name, each] : requirements.items()) {
    const Verdict verdict{each.at("passed"), number_of(each.at("margin")), number_of(each.at("value")),
                          number_of(each.at("time")), each.at("message")};
    assessment.requirements.push_back({name, each.at("text"), each.at("unit"), verdict});
  }
}

}  // namespace

std::string model_fingerprint(std::string_view model_text, const Diagram& diagram) {
  std::string all(model_text);
  // No model holds a byte 0, so that the ends of files are where they are.
  for (const UsedFile& used : diagram.used_files) all.append(1, '\0').append(used.text);
  return fingerprint(all);
}

std::string metadata_json(const RunResult& result, const RunInputs& inputs, std::string_view csv_name,
                          std::string_view csv) {
  Json json = {{"flyball", flyball_version()},
               {"status", to_string(result.status)},
               {"reason", result.reason},
               {"model", model_of(result, inputs)},
               {"seed", result.settings.seed},
               {"stop", result.settings.stop},
               {"end", result.end},
               {"solver", solver_of(result)},
               {"rows", result.log.rows()},
               {"columns", columns_of(result.log)},
               {"last_row", last_row_of(result.log)},
               {"libraries", Json::object()}};
  if (!result.assessment.metrics.empty()) json["metrics"] = metrics_of(result.assessment);
  if (!result.assessment.requirements.empty()) json["requirements"] = requirements_of(result.assessment);
  for (const Version& library : library_versions()) json["libraries"][library.name] = library.number;
  if (!csv.empty()) json["csv"] = {{"file", csv_name}, {"checksum", fingerprint(csv)}};
  // A path need not be UTF-8, JSON must be.
  std::string text = json.dump(2, ' ', false, Json::error_handler_t::replace);
  if (csv.empty()) return text + '\n';
  text.resize(text.size() - std::string_view("\n}").size());
  return text + seal_of(text);
}

ResultFacts read_result_facts(std::string_view text) {
  try {
    const Json json = Json::parse(text);
    ResultFacts facts;
    read_model(json.at("model"), facts);
    read_solver(json.at("solver"), facts);
    facts.status = json.at("status");
    facts.reason = json.at("reason");
    facts.end = json.at("end");
    facts.stop = json.at("stop");
    facts.seed = json.at("seed");
    for (const Json& column : json.at("columns")) {
      const std::string unit = column.at("unit");
      if (column.at("name") != "time")
        facts.columns.push_back({column.at("name"), unit.empty() ? "any" : unit, -1});
    }
    read_assessment(json, facts.assessment);
    facts.flyball = json.at("flyball");
    for (const auto& [name, number] : json.at("libraries").items()) facts.libraries.push_back({name, number});
    return facts;
  } catch (const Json::exception&) {
    throw MetadataError("not the metadata of a result");
  }
}

CsvMetadata read_csv_metadata(std::string_view json) {
  require_seal(json);
  try {
    const Json parsed = Json::parse(json);
    CsvMetadata metadata{
        parsed.at("rows").get<std::size_t>(), {}, parsed.at("csv").at("checksum").get<std::string>()};
    for (const Json& column : parsed.at("columns"))
      metadata.columns.push_back(column.at("name").get<std::string>());
    return metadata;
  } catch (const Json::exception&) {
    throw MetadataError("not the metadata of a result");
  }
}

}  // namespace flyball
