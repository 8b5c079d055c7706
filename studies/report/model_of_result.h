#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "models/plan.h"

namespace flyball {

/// A model that a result came from.
struct UnchangedModel {
  std::string text;
  std::shared_ptr<const Plan> plan;  // nullptr where its file is not there any more, or says something else
};

UnchangedModel find_model(const std::string& file, const std::string& hash,
                          const std::vector<Override>& overrides);

/// The diagram as SVG, to stand in a page. Empty where it is too large to be looked at, and, with a warning,
/// where it cannot be drawn; `beside` is a file of the folder in which it is worked on.
std::string drawn_diagram(const Plan& plan, const std::filesystem::path& beside,
                          std::vector<std::string>& warnings);

}  // namespace flyball
