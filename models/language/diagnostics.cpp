#include "models/language/diagnostics.h"

#include <fmt/format.h>

#include <algorithm>

namespace flyball {

std::string to_string(const Diagnostic& diagnostic) {
  static constexpr const char* names[] = {"error", "warning", "note"};
  const char* severity = names[static_cast<int>(diagnostic.severity)];
  if (diagnostic.at.line == 0)
    return fmt::format("{}: {}: {}", diagnostic.file, severity, diagnostic.message);
  return fmt::format("{}:{}:{}: {}: {}", diagnostic.file, diagnostic.at.line, diagnostic.at.column, severity,
                     diagnostic.message);
}

void Diagnostics::error(Position at, std::string message) {
  ++errors_;
  all_.push_back({Diagnostic::Severity::error, file_, at, std::move(message)});
}

void Diagnostics::note(Position at, std::string message) {
  all_.push_back({Diagnostic::Severity::note, file_, at, std::move(message)});
}

void Diagnostics::warning(Position at, std::string message) {
  all_.push_back({Diagnostic::Severity::warning, file_, at, std::move(message)});
}

std::vector<Diagnostic> Diagnostics::sorted() const {
  // A note sorts by the position of what it belongs to.
  std::vector<std::pair<Position, const Diagnostic*>> keyed;
  for (const Diagnostic& diagnostic : all_) {
    const bool follows = diagnostic.severity == Diagnostic::Severity::note && !keyed.empty();
    keyed.emplace_back(follows ? keyed.back().first : diagnostic.at, &diagnostic);
  }
  std::ranges::stable_sort(keyed, {}, [](const auto& entry) { return entry.first; });
  std::vector<Diagnostic> result;
  for (const auto& [at, diagnostic] : keyed) result.push_back(*diagnostic);
  return result;
}

}  // namespace flyball
