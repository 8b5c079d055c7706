#include "studies/versions.h"

namespace flyball {

std::string flyball_version() { return FLYBALL_VERSION; }

std::vector<Version> library_versions() {
  return {{"sundials", FLYBALL_SUNDIALS_VERSION},
          {"ceres", FLYBALL_CERES_VERSION},
          {"eigen", FLYBALL_EIGEN_VERSION},
          {"compiler", FLYBALL_COMPILER}};
}

}  // namespace flyball
