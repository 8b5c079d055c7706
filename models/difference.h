#pragma once

#include <string>
#include <vector>

#include "models/diagram.h"
#include "models/language/toml.h"

namespace flyball {

/// One thing in which two models differ.
struct Difference {
  enum class Kind { added, removed, changed };

  Kind kind = Kind::changed;
  std::string section;        // "blocks", "wires", "parameters", …
  std::string name;           // "K1.gain", "gamma.y -> K1.u"
  std::string before, after;  // as TOML; empty where there is none, and for wires
};

/// A model as it was written and as it was understood.
struct ComparedModel {
  const TomlValue& text;
  const Diagram& diagram;
};

/// All differences, section by section, in the order of the files. Layout, comments, the order of entries,
/// the unit in which a value is written, and whether a wire names a port that it need not name make none.
std::vector<Difference> compare(const ComparedModel& before, const ComparedModel& after);

}  // namespace flyball
