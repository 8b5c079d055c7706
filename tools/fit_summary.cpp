#include "tools/fit_summary.h"

#include <fmt/format.h>

#include <cmath>

#include "studies/table.h"

namespace flyball {
namespace {

std::string counted(int n, const char* thing) { return fmt::format("{} {}{}", n, thing, n == 1 ? "" : "s"); }

std::string parameter_table(const FitResult& result) {
  Table table({"parameter", "start", "value", "standard error", "unit"});
  for (const FittedParameter& p : result.parameters) {
    table.row({p.name, fmt::format("{:.6g}", p.start), fmt::format("{:.8g}", p.value),
               std::isfinite(p.standard_error) ? fmt::format("{:.2g}", p.standard_error) : "-",
               p.unit == "1" ? "" : p.unit});
  }
  return table.text();
}

std::string correlation_table(const FitResult& result) {
  const std::size_t n = result.parameters.size();
  if (n < 2 || result.correlation.empty() || std::isnan(result.condition)) return {};
  std::vector<std::string> header = {"correlation"};
  for (const FittedParameter& p : result.parameters) header.push_back(p.name);
  Table table(header);
  for (std::size_t p = 0; p < n; ++p) {
    std::vector<std::string> row = {result.parameters[p].name};
    for (std::size_t q = 0; q <= p; ++q) row.push_back(fmt::format("{:.3f}", result.correlation[p * n + q]));
    table.row(std::move(row));
  }
  return '\n' + table.text();
}

std::string settings_line(const FitResult& result, const FitInputs& inputs) {
  std::string line = fmt::format("\nflyball run {}", inputs.model_file);
  for (const FittedParameter& p : result.parameters) line += fmt::format(" --set {}={:.8g}", p.name, p.value);
  return line + '\n';
}

}  // namespace

std::string fit_summary(const FitResult& result, const FitInputs& inputs,
                        const std::vector<std::filesystem::path>& files) {
  std::string text = fmt::format("{} ({})\n", inputs.title, inputs.model_file);
  text += fmt::format("  fit       {}: {}; {}, {}, {} gradient\n",
                      result.converged ? "converged" : "not converged", result.reason,
                      counted(result.iterations, "iteration"), counted(result.simulations, "simulation"),
                      result.gradient);
  text += fmt::format("  cost      {:.6g} before, {:.6g} after, of {}\n", result.cost_before, result.cost,
                      counted(result.residuals, "residual"));
  if (std::isfinite(result.condition)) text += fmt::format("  condition {:.3g}\n", result.condition);
  for (const auto& file : files)
    text += fmt::format("  {}  {}\n", file == files.front() ? "files   " : "        ", file.string());
  text += '\n' + parameter_table(result) + correlation_table(result);
  if (!result.remarks.empty()) text += '\n';
  for (const std::string& remark : result.remarks) text += fmt::format("- {}\n", remark);
  return text + settings_line(result, inputs);
}

}  // namespace flyball
