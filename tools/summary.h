#pragma once

#include <string>

#include "studies/result.h"

namespace flyball {

/// What a run did, in a few lines.
std::string run_summary(const RunResult& result, const RunInputs& inputs, bool method_from_command_line);

/// The last row of the log, a line a signal, with units.
std::string final_values(const Log& log);

/// A table of metrics and one of requirements with their verdicts, each behind an empty line; nothing
/// without.
std::string assessment_tables(const Assessment& assessment);

}  // namespace flyball
