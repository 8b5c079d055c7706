#pragma once

#include "studies/language/sections.h"

namespace flyball {

/// The parameters that a fit or a front looks for, in the table (name to [lower, upper], or to { range,
/// start, scale }) or list (names) under `parameters`. Without `open`, each needs bounds.
std::vector<Sought> read_sought(const StudyDraft& draft, const TomlValue& parameters, int model, bool open);

/// The models that a fit or a front is for: the one that it names, or all.
std::vector<int> read_models_of(const StudyDraft& draft, const TomlValue& table);

}  // namespace flyball
