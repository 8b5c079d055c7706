#include "studies/language/model_findings.h"

#include <algorithm>
#include <map>

#include "models/language/messages.h"
#include "studies/language/study_messages.h"

namespace flyball {
namespace {

void add(Diagnostic::Severity severity, Position at, std::string message, Diagnostics& study) {
  switch (severity) {
    case Diagnostic::Severity::error:
      return study.error(at, std::move(message));
    case Diagnostic::Severity::warning:
      return study.warning(at, std::move(message));
    case Diagnostic::Severity::note:
      return study.note(at, std::move(message));
  }
}

}  // namespace

void take_findings(const Diagnostics& found, const ModelUse& use, Diagnostics& study,
                   const std::vector<PlacedOverride>& overrides) {
  std::map<std::string, int> sources;
  const auto source_of = [&](const std::string& file) {
    const auto known = sources.find(file);
    if (known != sources.end()) return known->second;
    return sources.emplace(file, study.add_source(file, use.at, use.name)).first->second;
  };
  for (const Diagnostic& diagnostic : found.sorted()) {
    const auto about = std::ranges::find_if(overrides, [&](const PlacedOverride& placed) {
      return diagnostic.at.line == 0 &&
             diagnostic.message.starts_with(message::in_override(placed.given.name, ""));
    });
    if (about == overrides.end()) {
      Position at = diagnostic.at;
      at.source = source_of(diagnostic.file);
      add(diagnostic.severity, at, diagnostic.message, study);
    } else {
      std::string said = diagnostic.message.substr(message::in_override(about->given.name, "").size());
      if (use.one_of_several) said = message::in_model(said, use.name);
      add(diagnostic.severity, about->at, std::move(said), study);
    }
  }
}

}  // namespace flyball
