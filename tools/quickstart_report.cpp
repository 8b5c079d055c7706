// The arc follower of models/line_arc/arc_error_loop.toml with four gains, compared with the closed forms of
// the linearised loop; called by tools/quickstart.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "studies/figure.h"
#include "studies/file.h"
#include "studies/gnuplot.h"
#include "studies/result.h"
#include "studies/table.h"
#include "tools/arc_loop.h"
#include "tools/console.h"
#include "tools/exit_status.h"
#include "tools/model_file.h"

namespace flyball {
namespace {

namespace fs = std::filesystem;

struct Case {
  double gain = 0.0;
  std::string csv;
  ArcMeasures measured, linear;
};

/// Runs the model with one gain and leaves its results in `folder`.
Case run_case(const std::string& model_name, const std::string& gain, const std::string& csv,
              const fs::path& folder) {
  const std::vector<Override> overrides{{"K_gamma", gain}};
  const ModelFile model = load_model(model_name, overrides);
  complain(listing(model.diagnostics));
  if (!model.plan) throw std::runtime_error("the model has errors");
  SimulationSettings settings = model.plan->diagram->simulation;
  settings.stop = arc_horizon;
  settings.log_interval = arc_log_interval;
  const RunResult result = run_plan(model.plan, settings);
  if (result.status != RunStatus::finished) throw std::runtime_error(result.reason);
  const ArcLoop loop = arc_loop_of(*model.plan);
  write_result(result, {model.name, model.text, overrides}, folder / csv);
  return {loop.K_gamma, csv, measure(result.log), linear_response(loop)};
}

std::string comparison_table(const std::vector<Case>& cases) {
  Table table(
      {"K_gamma", "damping", "run", "linear", "diff", "run", "linear", "diff", "run", "linear", "diff"});
  table.group(2, 3, "overshoot [%]");
  table.group(5, 3, "2 % settling [s]");
  table.group(8, 3, "ISE [mm^2 s]");
  const auto triple = [](std::vector<std::string>& cells, double run, double linear) {
    for (const double x : {run, linear}) cells.push_back(fmt::format("{:.3f}", x));
    cells.push_back(fmt::format("{:+.3f}", run - linear));
  };
  for (const Case& c : cases) {
    std::vector<std::string> cells{fmt::format("{:.4f}", c.gain), fmt::format("{:.4f}", c.linear.damping)};
    triple(cells, c.measured.overshoot, c.linear.overshoot);
    triple(cells, c.measured.settling, c.linear.settling);
    triple(cells, 1e6 * c.measured.ise, 1e6 * c.linear.ise);
    table.row(std::move(cells));
  }
  return table.text();
}

Figure comparison_figure(const std::vector<Case>& cases) {
  Figure figure{"Arc follower: distance and heading error for four gains", {}, 8.0};
  Panel distance{"distance error H [mm]", {}}, heading{"heading error γ [deg]", {}};
  for (const Case& c : cases) {
    const std::string label = fmt::format("Kγ = {:.2f}, ζ = {:.2f}", c.gain, c.linear.damping);
    distance.curves.push_back({c.csv, 2, label, 1e3});
    heading.curves.push_back({c.csv, 3, label, 180.0 / std::numbers::pi});
  }
  figure.panels = {distance, heading};
  return figure;
}

void draw_comparison(const std::vector<Case>& cases, const fs::path& folder) {
  const fs::path script = folder / "comparison.gp";
  write_file(script, gnuplot_script(comparison_figure(cases), "comparison"));
  for (const std::string format : {"svg", "png"}) {
    const Drawing drawing = draw(script, folder / ("comparison." + format), format);
    if (!drawing.drawn) complain(fmt::format("warning: {}\n", drawing.warning));
  }
}

int report(const std::string& model, const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw OutputError(folder, "cannot be created", error.value());
  std::vector<Case> cases;
  // The third gain makes the loop critical.
  for (const auto& [gain, name] : {std::pair("0.2", "0.20"), std::pair("0.5", "0.50"),
                                   std::pair("sqrt(2*K_H*L)", "1.10"), std::pair("2.0", "2.00")}) {
    cases.push_back(run_case(model, gain, fmt::format("gain_{}.csv", name), folder));
  }
  draw_comparison(cases, folder);
  print(comparison_table(cases));
  return exit_done;
}

}  // namespace
}  // namespace flyball

int main(int argc, char** argv) {
  using namespace flyball;
  reserve_standard_streams();
  if (argc != 3) {
    complain("usage: quickstart_report MODEL FOLDER\n");
    return exit_usage;
  }
  try {
    return report(argv[1], argv[2]);
  } catch (const FileError& error) {
    complain(fmt::format("error: {}\n", error.what()));
    return exit_input_output;
  } catch (const std::runtime_error& error) {
    complain(fmt::format("error: {}\n", error.what()));
    return exit_numerical_failure;
  }
}
