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
/// its tolerances and statistics, status, versions, and, where `csv` is given, the file's name and checksum.
/// An unknown unit is empty. Nothing in it depends on the machine's speed: equal runs give equal bytes.
std::string metadata_json(const RunResult& result, const RunInputs& inputs, std::string_view csv_name = {},
                          std::string_view csv = {});

}  // namespace flyball
