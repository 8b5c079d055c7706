#include "studies/result.h"

#include "studies/csv.h"
#include "studies/figure.h"
#include "studies/file.h"
#include "studies/gnuplot.h"

namespace flyball {

namespace fs = std::filesystem;

void draw_figures(const fs::path& script, ResultFiles& written) {
  for (const std::string format : {"svg", "png"}) {
    const fs::path figure = fs::path(script).replace_extension(format);
    const Drawing drawing = draw(script, figure, format);
    if (drawing.drawn) {
      written.files.push_back(figure);
    } else {
      written.warnings.push_back(drawing.warning);
    }
  }
}

ResultFiles write_result(const RunResult& result, const RunInputs& inputs, const fs::path& csv) {
  ResultFiles written;
  const auto write = [&](const fs::path& file, const std::string& content) {
    write_file(file, content);
    written.files.push_back(file);
  };
  const std::string name = csv.filename().string();
  const std::string rows = to_csv(result.log);
  write(csv, rows);
  write(fs::path(csv).replace_extension("json"), metadata_json(result, inputs, name, rows));
  if (result.log.width() == 0 || result.log.rows() == 0) return written;
  const Diagram& diagram = *result.plan->diagram;
  const std::string title = diagram.title.empty() ? fs::path(diagram.file).stem().string() : diagram.title;
  const fs::path script = fs::path(csv).replace_extension("gp");
  write(script, gnuplot_script(figure_of(result.log.columns(), title, name), csv.stem().string()));
  draw_figures(script, written);
  return written;
}

}  // namespace flyball
