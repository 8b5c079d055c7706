#include "studies/language/run_table.h"

#include <algorithm>

namespace flyball {
namespace {

/// The last digit of a number whose digits have this base; the number loses it.
std::int64_t take_digit(std::int64_t& number, std::int64_t base) {
  const std::int64_t digit = number % base;
  number /= base;
  return digit;
}

}  // namespace

RunTable::RunTable(const Study& study, std::vector<Choice> cases)
    : study_(&study), cases_(std::move(cases)), sampler_(study.monte_carlo, study.seed) {}

std::int64_t RunTable::size() const {
  return static_cast<std::int64_t>(study_->models.size() * cases_.size() * study_->scenarios.size()) *
         study_->sweep.points() * study_->monte_carlo.runs;
}

RunPlace RunTable::place(std::int64_t run) const {
  RunPlace place;
  place.sample = static_cast<int>(take_digit(run, study_->monte_carlo.runs));
  place.sweep = take_digit(run, study_->sweep.points());
  place.scenario = static_cast<int>(take_digit(run, static_cast<std::int64_t>(study_->scenarios.size())));
  place.choice = static_cast<int>(take_digit(run, static_cast<std::int64_t>(cases_.size())));
  place.model = static_cast<int>(run);
  return place;
}

std::vector<Setting> RunTable::sweep_settings(std::int64_t point) const {
  std::vector<Setting> settings;
  const SweepGrid& sweep = study_->sweep;
  for (auto axis = sweep.axes.rbegin(); axis != sweep.axes.rend(); ++axis) {
    const auto count = static_cast<std::int64_t>(axis->values.size());
    const std::int64_t k = sweep.zipped ? point : take_digit(point, count);
    settings.push_back({axis->name, axis->values[static_cast<std::size_t>(k)]});
  }
  std::ranges::reverse(settings);
  return settings;
}

RunRequest RunTable::request(std::int64_t run) const {
  const RunPlace at = place(run);
  RunRequest request;
  request.model = at.model;
  request.seed = sampler_.seed(at.sample);
  const auto add = [&](const std::vector<Setting>& settings) {
    for (const Setting& setting : settings) {
      if (setting.model < 0 || setting.model == at.model) request.settings.push_back(setting);
    }
  };
  add(sweep_settings(at.sweep));
  const auto& spread = study_->monte_carlo.spread;
  for (std::size_t p = 0; p < spread.size(); ++p)
    request.settings.push_back({spread[p].first, sampler_.draw(static_cast<int>(p), at.sample)});
  add(study_->scenarios[at.scenario].settings);
  add(cases_[at.choice].settings);
  return request;
}

}  // namespace flyball
