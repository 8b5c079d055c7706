#include "models/language/format.h"

#include <fmt/format.h>

#include <stdexcept>

#include "models/language/toml.h"
#include "models/read_file.h"
#include "studies/file.h"
#include "tools/commands.h"
#include "tools/console.h"
#include "tools/json.h"

namespace flyball {
namespace {

/// Nothing when the text is no TOML; what is wrong with it goes to standard error.
std::optional<std::string> formatted(const std::string& name, const std::string& text) {
  Diagnostics diagnostics(name);
  const auto before = parse_toml(text, diagnostics);
  if (before && !diagnostics.failed()) {
    std::string result = format_toml(text);
    const auto after = parse_toml(result, diagnostics);
    if (!after || !same_content(before->root(), after->root()))
      throw std::logic_error(name + ": the formatted text says something else");
    return result;
  }
  for (const Diagnostic& diagnostic : diagnostics.sorted()) complain(to_string(diagnostic) + '\n');
  return std::nullopt;
}

}  // namespace

int format_command(const FormatOptions& options) {
  int status = exit_done;
  std::vector<FormattedFile> files;
  for (const std::string& name : options.files) {
    const std::string text = read_file(name, largest_model);
    const auto result = formatted(name, text);
    if (!result) {
      status = exit_model_error;
      continue;
    }
    const bool changed = *result != text;
    files.push_back({name, changed});
    if (!changed) continue;
    if (!options.check) {
      write_file(name, *result);
    } else if (status == exit_done) {
      status = exit_requirement_failed;
    }
    if (!options.json)
      print(fmt::format("{}: {}\n", name, options.check ? "would be formatted" : "formatted"));
  }
  if (options.json) print(format_json(files));
  return status;
}

}  // namespace flyball
