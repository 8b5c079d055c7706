#include "studies/gnuplot.h"

#include <fmt/format.h>

#include "studies/figure.h"
#include "studies/file.h"
#include "studies/process.h"

namespace flyball {

namespace fs = std::filesystem;

Drawing draw(const fs::path& script, const fs::path& figure, const std::string& format) {
  const TemporaryFile part(figure);
  const std::string settings = fmt::format("format = {}; figure = {}", gnuplot_quoted(format),
                                           gnuplot_quoted(part.path().filename().string()));
  const fs::path folder = script.has_parent_path() ? script.parent_path() : ".";
  // "./": a script whose name begins with a dash is no option.
  const int status = run_process({"gnuplot", "-e", settings, "./" + script.filename().string()}, folder);
  if (status == 0) {
    keep_drawing(part.path(), figure);
    return {true, {}};
  }
  if (status == -1) {
    return {false,
            fmt::format("{}: not drawn: gnuplot is not installed (Debian: apt-get install gnuplot-nox); "
                        "later, run gnuplot on {}",
                        figure.string(), script.string())};
  }
  return {false, fmt::format("{}: not drawn: gnuplot ended with status {}; run it on {} to see why",
                             figure.string(), status, script.string())};
}

}  // namespace flyball
