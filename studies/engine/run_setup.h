#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "solvers/parameters.h"
#include "studies/language/study.h"

namespace flyball {

/// A run that is ready: on which plan, with which numbers.
struct RunSetup {
  std::shared_ptr<const Plan> plan;
  SimulationSettings settings;
  ParameterSet parameters;
  std::string form;  // equal for runs that differ in `parameters` alone
};

/// Plans of a study's models by what changes their structure, and the way from settings by name to slots.
/// Any number of threads may ask.
class Setups {
 public:
  explicit Setups(const std::vector<StudyModel>& models) : models_(models) {}

  /// A number that has no slot of its own - a sample time, what a formula computes - is read as a text.
  /// Throws std::invalid_argument with what is wrong.
  RunSetup make(int model, std::span<const Setting> settings);

 private:
  class Form;
  struct Kept {
    std::shared_ptr<Form> form;
    long used = 0;
  };

  std::shared_ptr<Form> form_of(int model, const std::vector<Setting>& texts);

  const std::vector<StudyModel>& models_;
  std::mutex guard_;
  std::map<std::string, Kept> forms_;
  long uses_ = 0;
};

}  // namespace flyball
