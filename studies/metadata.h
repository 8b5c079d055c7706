#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "studies/run.h"

namespace flyball {

/// What a run was made from, for its metadata.
struct RunInputs {
  std::string model_file;
  std::string model_text;
  std::vector<Override> overrides;
};

/// The sidecar of a result, as JSON text: model (with a hash of its text), columns with units, solver with
/// its tolerances and statistics, status, versions, and, where there is a CSV file, its name and checksum.
std::string metadata_json(const RunResult& result, const RunInputs& inputs, std::string_view csv_name = {},
                          std::string_view csv = {});

}  // namespace flyball
