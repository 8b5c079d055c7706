#pragma once

#include <optional>
#include <string>
#include <vector>

#include "studies/engine/study_table.h"

namespace flyball {

/// What all runs of a study say to one requirement.
struct RequirementSummary {
  struct Worst {
    std::int64_t run = 0;
    RunPlace place;
    Verdict verdict;
  };

  std::string name, text, unit;
  std::int64_t runs = 0, passed = 0;
  std::optional<Worst> worst;  // that with the smallest margin; one without a margin is worse than any

  bool holds() const { return passed == runs; }
};

std::vector<RequirementSummary> summarise_requirements(const StudyData& data);

/// A row a requirement, for requirements.csv and for people.
std::string requirements_csv(const std::vector<RequirementSummary>& summaries);
std::string requirements_text(const StudyData& data, const std::vector<RequirementSummary>& summaries);

/// "requirement calm: …" of those that do not hold, a line each: the worst violation.
std::string violations(const StudyData& data, const std::vector<RequirementSummary>& summaries);

}  // namespace flyball
