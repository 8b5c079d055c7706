#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "blocks/registry.h"
#include "models/difference.h"
#include "studies/result_check.h"
#include "tools/model_file.h"

namespace flyball {

/// A study that was read: how many runs it asks for, and what was found.
struct CheckedStudy {
  std::string name;
  std::vector<Diagnostic> diagnostics;
  std::int64_t runs = 0;
};

/// {"models": [{"file", "ok", "blocks", "states", "rates", "crossings", "diagnostics": […]}]}; with
/// `units` also the signals and parameters with their units, and notes. Where results were checked, too,
/// "results": [{"file", "ok", "rows", "columns", "diagnostics"}], and "studies": [{"file", "ok", "runs",
/// "diagnostics"}].
std::string check_json(const std::vector<ModelFile>& models, bool units = false,
                       const std::vector<ResultCheck>& results = {},
                       const std::vector<CheckedStudy>& studies = {});

/// {"differences": [{"kind", "section", "name", "before", "after"}]}
std::string diff_json(const std::vector<Difference>& differences);

struct FormattedFile {
  std::string name;
  bool changed;
};
/// {"files": [{"file", "changed"}]}
std::string format_json(const std::vector<FormattedFile>& files);

/// {"blocks": [{"name", "type", "family", "rate"}], "wires": [{"from", "to"}], "order": [{"block",
/// "computes"}]}
std::string graph_json(const Plan& plan);

/// {"blocks": [{"name", "family", "summary", "structure", "parameters", "inputs", "outputs", …}]}
std::string blocks_json(const std::vector<const BlockType*>& types);

}  // namespace flyball
