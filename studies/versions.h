#pragma once

#include <string>
#include <vector>

namespace flyball {

struct Version {
  std::string name;
  std::string number;
};

std::string flyball_version();

/// The libraries that results depend on, as they were when Flyball was built.
std::vector<Version> library_versions();

}  // namespace flyball
