#include <fmt/format.h>

#include <filesystem>

#include "studies/file.h"
#include "studies/report/report_files.h"
#include "studies/result_check.h"
#include "tools/commands.h"
#include "tools/console.h"
#include "tools/model_file.h"

namespace flyball {

int report_command(const ReportOptions& options) {
  const std::filesystem::path csv(options.input);
  std::filesystem::path html(options.output);
  if (options.output.empty()) html = std::filesystem::path(csv).replace_extension("html");
  const ResultCheck check = check_result(csv);
  complain(listing(check.diagnostics));
  if (!check.ok()) return exit_model_error;
  for (const std::string& warning : write_result_report(csv, html))
    complain(fmt::format("warning: {}\n", warning));
  if (!options.quiet) print(html.string() + '\n');
  return exit_done;
}

}  // namespace flyball
