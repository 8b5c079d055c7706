#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "studies/metrics/program.h"
#include "studies/metrics/requirement.h"
#include "studies/metrics/tube.h"

namespace flyball {

enum class Order { less, less_equal, greater, greater_equal };

/// The unit in which people see a number.
struct DisplayUnit {
  double factor = 1.0;  // of it in SI
  std::string name;     // empty for a plain number

  std::string shown(double value) const;
};

/// Sides that are compared one with the next: "0 V <= u < 12 V".
struct Comparison {
  enum class When { number, always, eventually };

  When when = When::number;
  std::vector<SeriesExpression> sides;
  std::vector<std::string> side_texts;
  std::vector<Order> relations;              // between side k and k + 1
  std::optional<SeriesExpression> from, to;  // of a window of time [s]
};

/// A signal that stays in a tube.
struct Containment {
  SeriesExpression signal;
  std::string signal_text;
  std::shared_ptr<const Tube> tube;
  std::string file;
};

/// One of the statements of a requirement.
struct Clause {
  std::variant<Comparison, Containment> statement;
  DisplayUnit unit;
  std::string si_unit;  // of margin and value
};

/// What the run says to it.
Verdict check(const Clause& clause, const Evaluation& evaluation);

}  // namespace flyball
