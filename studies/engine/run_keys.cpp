#include "studies/engine/run_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>

#include "blocks/hash.h"
#include "studies/file.h"
#include "studies/metadata.h"
#include "studies/versions.h"

namespace flyball {
namespace {

namespace fs = std::filesystem;

/// Parts are told apart by a byte that no text holds.
void append_part(std::string& text, std::string_view part) { text.append(part).append(1, '\0'); }

/// All bits, so that no digit is lost.
void append_number(std::string& text, double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  for (int shift = 0; shift < 64; shift += 8) text += static_cast<char>(bits >> shift);
}

}  // namespace

RunKeys::RunKeys(const Study& study)
    : study_(study), study_folder_(fs::path(study.file).parent_path().string()) {
  for (const StudyModel& model : study.models) {
    const Diagram& diagram = *model.plan->diagram;
    std::string text;
    append_part(text, flyball_version());
    append_part(text, model_fingerprint(model.text, diagram));
    for (const DataFile& file : diagram.data_files) append_part(text, file.hash);
    for (const Metric& metric : model.metrics) {
      append_part(text, metric.text());
      append_part(text, files_named_in(metric.text()));
    }
    for (const Requirement& requirement : model.requirements) {
      append_part(text, requirement.text());
      append_part(text, files_named_in(requirement.text()));
    }
    models_.push_back(fingerprint(text));
  }
}

/// Hashes of the files that words of a text name, from the folder of the study or of a model.
std::string RunKeys::files_named_in(const std::string& text) {
  const auto [known, is_new] = files_.try_emplace(text);
  if (!is_new) return known->second;
  std::vector<fs::path> folders{study_folder_};
  for (const StudyModel& model : study_.models) folders.push_back(fs::path(model.file).parent_path());
  constexpr std::string_view ends = " \t()[],\"'";
  for (std::size_t at = 0; (at = text.find_first_not_of(ends, at)) != std::string::npos;) {
    const std::size_t end = std::min(text.find_first_of(ends, at), text.size());
    const std::string word = text.substr(at, end - at);
    at = end;
    if (word.find('.') == std::string::npos) continue;
    for (const fs::path& folder : folders) {
      std::error_code error;
      if (fs::is_regular_file(folder / word, error)) known->second += fingerprint(read_file(folder / word));
    }
  }
  return known->second;
}

void RunKeys::append(std::string& text, std::span<const Setting> settings) {
  for (const Setting& setting : settings) {
    append_part(text, setting.name);
    if (const double* number = std::get_if<double>(&setting.value)) {
      append_number(text, *number);
    } else {
      append_part(text, std::get<std::string>(setting.value));
      append_part(text, files_named_in(std::get<std::string>(setting.value)));
    }
  }
  text += '\1';
}

std::vector<std::uint64_t> RunKeys::of(std::span<const RunRequest> group) {
  std::string text;
  for (const RunRequest& request : group) {
    append_part(text, models_[request.model]);
    append(text, request.settings);
    append_number(text, std::bit_cast<double>(request.seed));
  }
  std::vector<std::uint64_t> keys;
  for (std::size_t k = 0; k < group.size(); ++k) {
    text += static_cast<char>(k);
    keys.push_back(fnv1a(text));
  }
  return keys;
}

void RunKeys::append(std::string& text, const std::vector<Sought>& parameters) {
  for (const Sought& sought : parameters) {
    append_part(text, sought.name);
    for (const double x : {sought.lower, sought.upper, sought.start.value_or(NAN), sought.scale})
      append_number(text, x);
  }
  text += '\1';
}

std::uint64_t RunKeys::of(const FitDefinition& fit) {
  std::string text;
  append_part(text, models_[fit.model]);
  append(text, fit.parameters);
  for (const FitExperiment& experiment : fit.experiments) {
    append_part(text, experiment.data.empty() ? "" : fingerprint(read_file(experiment.data)));
    for (const auto& match : experiment.matches) {
      append_part(text, match.signal);
      append_part(text, match.column);
      append_number(text, match.weight);
    }
    append(text, experiment.settings);
  }
  append_part(text, fmt::format("{} {} {} {} {} {} {}", fmt::join(fit.requirements, ","),
                                fmt::join(fit.minimise, ","), fit.loss, fit.loss_scale, fit.starts,
                                fit.gradient, fit.max_iterations));
  append_part(text, std::to_string(study_.seed));
  return fnv1a(text);
}

std::uint64_t RunKeys::of(const ParetoDefinition& front) {
  std::string text;
  append_part(text, models_[front.model]);
  append(text, front.parameters);
  append_part(text, fmt::format("{} {} {} {} {} {} {} {} {}", front.algorithm, front.evaluations,
                                front.population, fmt::join(front.minimise, ","),
                                fmt::join(front.maximise, ","), fmt::join(front.requirements, ","),
                                fmt::join(front.reference, ","), front.pick, fmt::join(front.weights, ",")));
  // Without numbers it is the first one.
  for (std::size_t k = 0; k < study_.scenarios.size(); ++k) {
    const bool looked_at = std::ranges::find(front.scenarios, static_cast<int>(k)) != front.scenarios.end();
    if (looked_at || (front.scenarios.empty() && k == 0)) append(text, study_.scenarios[k].settings);
  }
  append_part(text, std::to_string(study_.seed));
  return fnv1a(text);
}

}  // namespace flyball
