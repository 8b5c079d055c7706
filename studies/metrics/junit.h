#pragma once

#include <string>
#include <vector>

#include "studies/metrics/assessment.h"

namespace flyball {

/// The requirements of one run, or of one case of a study.
struct JUnitSuite {
  std::string name;
  const Assessment* assessment = nullptr;
};

/// Verdicts as JUnit XML, which continuous integration reads: a test case a requirement, metrics as
/// properties. No times in it: equal runs give equal bytes.
std::string junit_xml(const std::vector<JUnitSuite>& suites);

}  // namespace flyball
