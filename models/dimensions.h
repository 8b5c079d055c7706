#pragma once

#include <string>
#include <vector>

#include "models/diagram.h"

namespace flyball {

/// A signal or parameter with its SI unit, such as "m/s", "1" for a plain number; empty where the model does
/// not determine it.
struct NamedUnit {
  std::string name;
  std::string unit;
};

/// All that is known of the dimensions of a diagram.
struct DimensionTable {
  std::vector<NamedUnit> signals;
  std::vector<NamedUnit> parameters;
  std::vector<Diagnostic> notes;  // factors that hide a unit
};

/// Runs the equations of a diagram on the dimension scalar. Reports units that contradict each other, with
/// the equations between them and what each would have to be; logged signals get the unit that is found. In a
/// model with units, factors that hide one are noted. A model without units is never refused.
void check_dimensions(Diagram& diagram, Diagnostics& diagnostics);

DimensionTable dimension_table(const Diagram& diagram);

}  // namespace flyball
