#pragma once

#include <memory>
#include <string>
#include <vector>

#include "models/plan.h"
#include "studies/metadata.h"
#include "studies/report/html_page.h"

namespace flyball {

/// The rows of a result, column by column, in SI.
struct ResultCurves {
  std::vector<double> time;
  std::vector<std::vector<double>> values;  // of each column
};

ResultCurves curves_of(const Log& log);

/// What a report of one run is made from.
struct RunReportSources {
  ResultFacts facts;
  ResultCurves curves;
  std::string model_text;            // empty: it is not there any more, or has changed
  std::shared_ptr<const Plan> plan;  // may be nullptr
  std::string diagram_svg;           // empty: not drawn
};

/// Figures, verdicts, solver, model and versions of one run.
HtmlPage run_page(const RunReportSources& sources);

/// Columns P.x, P.y and P.theta (or heading, psi) are the pose of a robot: its way.
std::vector<HtmlPath> robot_paths(const std::vector<LogColumn>& columns, const ResultCurves& curves);

}  // namespace flyball
