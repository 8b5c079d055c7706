#pragma once

#include <string>

#include "studies/run.h"

namespace flyball {

/// The tables of `flyball run --profile`. `result.profile` is there.
std::string profile_text(const RunResult& result);

/// The JSON text of a run's metadata with "profile" behind it: {"evaluations": {"points", "seconds",
/// "blocks":
/// [{"block", "type", "seconds"}]}, "events": [{"event", "count"}], "steps": {"spans": [{"begin", "end",
/// "steps", "shortest", "longest"}], "until_instant", "at_max_step", "by_method", "limiting": [{"state",
/// "steps"}]}}
std::string with_profile(const std::string& metadata, const Profile& profile);

}  // namespace flyball
