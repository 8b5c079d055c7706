#pragma once

#include <vector>

#include "models/diagram.h"
#include "models/diagram_report.h"

namespace flyball {

/// [metrics] or [requirements]: texts by name. Those who run the model read them, when it is known what it
/// logs. `section` may be nullptr.
std::vector<Question> read_questions(const TomlValue* section, const Report& report);

}  // namespace flyball
