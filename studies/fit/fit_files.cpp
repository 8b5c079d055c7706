#include "studies/fit/fit_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "models/language/names.h"
#include "studies/figure.h"
#include "studies/file.h"
#include "studies/gnuplot.h"

namespace flyball {
namespace {

namespace fs = std::filesystem;

/// A key of TOML: dotted names stand in quotes.
std::string toml_key(const std::string& name) { return is_name(name) ? name : fmt::format("\"{}\"", name); }

/// A number of TOML is a float only with a point or an exponent.
std::string toml_number(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

std::string comment(const FittedParameter& p) {
  std::string text = fmt::format("# {}", p.name);
  if (!p.unit.empty() && p.unit != "1") text += fmt::format(" [{}]", p.unit);
  text += fmt::format(" from {}", p.start);
  if (std::isfinite(p.standard_error)) text += fmt::format(", standard error {:.3g}", p.standard_error);
  return text + (p.at_bound ? ", at its bound\n" : "\n");
}

Figure figure_of(const FittedExperiment& experiment, const std::string& title, const std::string& csv) {
  Figure figure{title, {}, experiment.times.back()};
  int column = 2;
  for (const FittedSignal& signal : experiment.signals) {
    Panel panel{axis_label(signal.signal, signal.unit), {}};
    for (const char* curve : {"data", "before", "after"}) panel.curves.push_back({csv, column++, curve});
    panel.curves.front().points = true;
    figure.panels.push_back(std::move(panel));
  }
  return figure;
}

/// A name that any file system takes.
std::string file_stem(std::string name) {
  for (char& c : name) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '.';
    if (!plain) c = '_';
  }
  return name;
}

class Writer {
 public:
  Writer(const FitResult& result, const FitInputs& inputs, const fs::path& folder)
      : result_(result), inputs_(inputs), folder_(folder) {}

  ResultFiles write() {
    file(inputs_.stem + ".json", fit_json(result_, inputs_));
    file(inputs_.stem + ".toml", fit_cases(result_));
    for (const FittedExperiment& experiment : result_.experiments) write_experiment(experiment);
    return std::move(written_);
  }

 private:
  void file(const std::string& name, const std::string& content) {
    write_file(folder_ / name, content);
    written_.files.push_back(folder_ / name);
  }

  void write_experiment(const FittedExperiment& experiment) {
    // Without a start that can be simulated there is nothing to compare.
    if (experiment.signals.empty() || experiment.signals.front().after.empty()) return;
    const bool several = result_.experiments.size() > 1;
    const std::string stem = several ? inputs_.stem + "_" + file_stem(experiment.name) : inputs_.stem;
    const std::string title = several ? inputs_.title + ": " + experiment.name : inputs_.title;
    file(stem + ".csv", fit_csv(experiment));
    file(stem + ".gp", gnuplot_script(figure_of(experiment, title, stem + ".csv"), stem));
    for (const std::string format : {"svg", "png"}) {
      const fs::path figure = folder_ / (stem + "." + format);
      const Drawing drawing = draw(folder_ / (stem + ".gp"), figure, format);
      if (drawing.drawn) {
        written_.files.push_back(figure);
      } else {
        written_.warnings.push_back(drawing.warning);
      }
    }
  }

  const FitResult& result_;
  const FitInputs& inputs_;
  fs::path folder_;
  ResultFiles written_;
};

}  // namespace

std::string fit_cases(const FitResult& result) {
  std::string text = fmt::format("# Found by a fit: {}. Cost {:.6g} before, {:.6g} after.\n", result.reason,
                                 result.cost_before, result.cost);
  for (const FittedParameter& p : result.parameters) text += comment(p);
  text += fmt::format("\n[cases]\n{} = {{ ", toml_key(result.name));
  for (const FittedParameter& p : result.parameters) {
    const bool last = &p == &result.parameters.back();
    text += fmt::format("{} = {}{}", toml_key(p.name), toml_number(p.value), last ? " }\n" : ", ");
  }
  return text;
}

std::string fit_csv(const FittedExperiment& experiment) {
  std::string text = "time";
  for (const FittedSignal& s : experiment.signals)
    text += fmt::format(",{0}_data,{0}_before,{0}_after", s.signal);
  text += '\n';
  for (std::size_t row = 0; row < experiment.times.size(); ++row) {
    fmt::format_to(std::back_inserter(text), "{}", experiment.times[row]);
    for (const FittedSignal& s : experiment.signals)
      fmt::format_to(std::back_inserter(text), ",{},{},{}", s.data[row], s.before[row], s.after[row]);
    text += '\n';
  }
  return text;
}

ResultFiles write_fit(const FitResult& result, const FitInputs& inputs, const fs::path& folder) {
  return Writer(result, inputs, folder).write();
}

}  // namespace flyball
