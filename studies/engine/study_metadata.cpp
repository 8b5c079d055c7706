#include "studies/engine/study_metadata.h"

#include <cerrno>
#include <fstream>
#include <nlohmann/json.hpp>

#include "blocks/hash.h"
#include "studies/engine/run_study.h"
#include "studies/file.h"
#include "studies/metadata.h"
#include "studies/versions.h"

namespace flyball {
namespace {

// Keys in the order in which they are written here: people read these files, too.
using Json = nlohmann::ordered_json;

std::string text_of(const Json& json) {
  // A path need not be UTF-8, JSON must be.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

/// Of a file that may be larger than memory should be.
std::string file_fingerprint(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  Fingerprint fingerprint;
  std::vector<char> piece(1 << 16);
  while (file.read(piece.data(), static_cast<std::streamsize>(piece.size())) || file.gcount() > 0)
    fingerprint.add({piece.data(), static_cast<std::size_t>(file.gcount())});
  if (!file.eof()) throw FileError(path, "cannot be read", errno);
  return fingerprint.text();
}

Json models_of(const Study& study) {
  Json models = Json::array();
  for (const StudyModel& model : study.models) {
    const Diagram& diagram = *model.plan->diagram;
    Json json = {{"name", model.name},
                 {"file", model.file},
                 {"title", diagram.title},
                 {"hash", model_fingerprint(model.text, diagram)}};
    for (const UsedFile& used : diagram.used_files) json["uses"][used.name] = fingerprint(used.text);
    for (const DataFile& file : diagram.data_files) json["data"][file.name] = file.hash;
    models.push_back(std::move(json));
  }
  return models;
}

Json choices_of(const std::vector<Choice>& choices) {
  Json all = Json::array();
  for (const Choice& choice : choices) {
    Json json = {{"name", choice.name}};
    if (!choice.from.empty()) json["from"] = choice.from;
    json["set"] = Json::object();
    for (const Setting& setting : choice.settings)
      std::visit([&](const auto& value) { json["set"][setting.name] = value; }, setting.value);
    all.push_back(std::move(json));
  }
  return all;
}

Json questions_of(const auto& names, const auto& questions) {
  Json all = Json::array();
  for (std::size_t k = 0; k < names.size(); ++k)
    all.push_back({{"name", names[k].first}, {"text", names[k].second}, {"unit", questions[k].unit()}});
  return all;
}

}  // namespace

std::string study_json(const StudyData& data, const std::vector<Choice>& cases,
                       const std::vector<RequirementSummary>& requirements,
                       const std::vector<std::filesystem::path>& files) {
  const Study& study = data.study;
  Json json = {{"flyball", flyball_version()},
               {"study", {{"file", study.file}, {"title", study.title}, {"hash", fingerprint(study.text)}}},
               {"models", models_of(study)},
               {"seed", study.seed},
               {"cases", choices_of(cases)},
               {"scenarios", choices_of(study.scenarios)},
               {"sweep_points", study.sweep.points()},
               {"samples", study.monte_carlo.runs},
               {"runs", data.table.size()},
               {"failed", data.store.count(RunStatus::stopped)},
               {"metrics", questions_of(study.metrics, study.models[0].metrics)},
               {"requirements", questions_of(study.requirements, study.models[0].requirements)}};
  for (std::size_t k = 0; k < requirements.size(); ++k) {
    json["requirements"][k]["runs"] = requirements[k].runs;
    json["requirements"][k]["passed"] = requirements[k].passed;
  }
  for (const Version& library : library_versions()) json["libraries"][library.name] = library.number;
  json["files"] = Json::object();
  for (const auto& file : files) json["files"][file.filename().string()] = file_fingerprint(file);
  return text_of(json);
}

std::string status_json(const StudyRun& run) {
  return text_of({{"complete", run.complete()},
                  {"runs", run.runs},
                  {"finished", run.finished},
                  {"failed", run.failed},
                  {"searches", run.searches}});
}

}  // namespace flyball
