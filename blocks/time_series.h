#pragma once

#include <string>
#include <vector>

namespace flyball {

/// A signal that was read from a file. Immutable, and shared by all instances of one structure.
struct TimeSeries {
  std::string unit = "any";   // of `values`, SI
  std::vector<double> times;  // s; they do not fall, and two of one time are the sides of a jump
  std::vector<double> values;
};

}  // namespace flyball
