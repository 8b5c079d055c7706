#include "studies/engine/bisect_table.h"

#include "studies/engine/study_table.h"
#include "studies/table.h"

namespace flyball {

std::string bisections_csv(const Study& study, const std::vector<BisectResult>& results) {
  std::string text =
      csv_line({"bisection", "parameter", "case", "scenario", "value", "holds", "broken", "runs", "reason"});
  for (const BisectResult& result : results) {
    for (const BisectLimit& limit : result.limits) {
      text +=
          csv_line({result.name, result.parameter, study.cases[limit.choice].name,
                    study.scenarios[limit.scenario].name, csv_number(limit.value), csv_number(limit.holds),
                    csv_number(limit.broken), std::to_string(limit.runs), limit.reason});
    }
  }
  return text;
}

std::string bisections_text(const Study& study, const std::vector<BisectResult>& results) {
  Table table({"bisection", "case", "scenario", "parameter", "limit", ""});
  for (const BisectResult& result : results) {
    for (const BisectLimit& limit : result.limits) {
      table.row({result.name, study.cases[limit.choice].name, study.scenarios[limit.scenario].name,
                 result.parameter, shown_number(limit.value), limit.reason});
    }
  }
  return table.text();
}

}  // namespace flyball
