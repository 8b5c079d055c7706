#pragma once

#include <vector>

#include "models/diagram_report.h"
#include "studies/language/study.h"

namespace flyball {

/// The models that [study] names, read and planned. Those that cannot be are reported, and left out.
std::vector<StudyModel> read_study_models(const TomlValue& section, const Report& report,
                                          Diagnostics& diagnostics);

}  // namespace flyball
