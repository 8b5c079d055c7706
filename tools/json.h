#pragma once

#include <string>
#include <vector>

#include "blocks/registry.h"
#include "tools/model_file.h"

namespace flyball {

/// {"models": [{"file", "ok", "blocks", "states", "rates", "crossings", "diagnostics": […]}]}; with
/// `units` also the signals and parameters with their units, and notes.
std::string check_json(const std::vector<ModelFile>& models, bool units = false);

/// {"blocks": [{"name", "type", "family", "rate"}], "wires": [{"from", "to"}], "order": [{"block",
/// "computes"}]}
std::string graph_json(const Plan& plan);

/// {"blocks": [{"name", "family", "summary", "structure", "parameters", "inputs", "outputs", …}]}
std::string blocks_json(const std::vector<const BlockType*>& types);

}  // namespace flyball
