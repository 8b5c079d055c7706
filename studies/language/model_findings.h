#pragma once

#include <string>
#include <vector>

#include "models/diagram.h"

namespace flyball {

/// A value that a study gives to a model, and where it stands in the study.
struct PlacedOverride {
  Override given;
  Position at;
};

/// How a study uses a model.
struct ModelUse {
  Position at;
  std::string name;
  bool one_of_several = false;
};

/// Takes over what was found in a model into the diagnostics of the study that uses it. What is said of an
/// override is said where the study gives it.
void take_findings(const Diagnostics& found, const ModelUse& use, Diagnostics& study,
                   const std::vector<PlacedOverride>& overrides = {});

}  // namespace flyball
