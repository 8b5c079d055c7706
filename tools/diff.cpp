#include <fmt/format.h>

#include "models/difference.h"
#include "tools/commands.h"
#include "tools/console.h"
#include "tools/json.h"
#include "tools/model_file.h"

namespace flyball {
namespace {

TomlDocument parsed(const ModelFile& model) {
  Diagnostics ignored(model.name);  // it was read before
  return *parse_toml(model.text, ignored);
}

std::string line(const Difference& d) {
  switch (d.kind) {
    case Difference::Kind::added:
      return d.after.empty() ? fmt::format("  + {}\n", d.name)
                             : fmt::format("  + {} = {}\n", d.name, d.after);
    case Difference::Kind::removed:
      return d.before.empty() ? fmt::format("  - {}\n", d.name)
                              : fmt::format("  - {} = {}\n", d.name, d.before);
    case Difference::Kind::changed:
      return fmt::format("  ~ {}: {} -> {}\n", d.name, d.before, d.after);
  }
  return {};
}

std::string listing(const std::vector<Difference>& differences) {
  std::string text;
  const std::string* section = nullptr;
  for (const Difference& d : differences) {
    if (section == nullptr || *section != d.section) text += d.section + '\n';
    section = &d.section;
    text += line(d);
  }
  return text;
}

}  // namespace

int diff_command(const DiffOptions& options) {
  const ModelFile before = load_model(options.before, {}), after = load_model(options.after, {});
  complain(listing(before.diagnostics));
  complain(listing(after.diagnostics));
  if (!before.plan || !after.plan) return exit_model_error;
  const TomlDocument a = parsed(before), b = parsed(after);
  const auto differences = compare({a.root(), *before.plan->diagram}, {b.root(), *after.plan->diagram});
  print(options.json ? diff_json(differences) : listing(differences));
  return differences.empty() ? exit_done : exit_requirement_failed;
}

}  // namespace flyball
