#include "models/language/diagnostics.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "models/language/messages.h"

namespace flyball {

std::string to_string(const Diagnostic& diagnostic) {
  static constexpr const char* names[] = {"error", "warning", "note"};
  const char* severity = names[static_cast<int>(diagnostic.severity)];
  if (diagnostic.at.line == 0)
    return fmt::format("{}: {}: {}", diagnostic.file, severity, diagnostic.message);
  return fmt::format("{}:{}:{}: {}: {}", diagnostic.file, diagnostic.at.line, diagnostic.at.column, severity,
                     diagnostic.message);
}

int count_errors(const std::vector<Diagnostic>& diagnostics) {
  return static_cast<int>(
      std::ranges::count(diagnostics, Diagnostic::Severity::error, &Diagnostic::severity));
}

int Diagnostics::add_source(std::string file, Position used, std::string as) {
  sources_.push_back({std::move(file), used, std::move(as)});
  return static_cast<int>(sources_.size()) - 1;
}

const std::string& Diagnostics::file(int source) const {
  return sources_[static_cast<std::size_t>(source) < sources_.size() ? source : 0].file;
}

void Diagnostics::add(Diagnostic::Severity severity, Position at, std::string message) {
  if (severity != Diagnostic::Severity::note || all_.empty()) all_.emplace_back();
  all_.back().push_back({severity, file(at.source), at, std::move(message)});
}

void Diagnostics::error(Position at, std::string message) {
  ++errors_;
  add(Diagnostic::Severity::error, at, std::move(message));
}

void Diagnostics::note(Position at, std::string message) {
  add(Diagnostic::Severity::note, at, std::move(message));
}

void Diagnostics::warning(Position at, std::string message) {
  add(Diagnostic::Severity::warning, at, std::move(message));
}

void Diagnostics::append_uses(int source, std::vector<Diagnostic>& result) const {
  // The way out of a deep hierarchy is told from both of its ends.
  constexpr std::size_t most = 8;
  std::vector<const Source*> uses;
  while (source > 0 && source < static_cast<int>(sources_.size())) {
    uses.push_back(&sources_[source]);
    source = uses.back()->used.source;
  }
  if (uses.size() > most) uses.erase(uses.begin() + most / 2, uses.end() - most / 2);
  for (const Source* use : uses) {
    result.push_back(
        {Diagnostic::Severity::note, file(use->used.source), use->used, message::used_here(use->as)});
  }
}

std::vector<Diagnostic> Diagnostics::sorted() const {
  std::map<std::string_view, int> files;  // by first use
  for (const Source& source : sources_) files.emplace(source.file, static_cast<int>(files.size()));
  using Place = std::tuple<int, int, int>;
  std::vector<std::pair<Place, const std::vector<Diagnostic>*>> keyed;
  for (const auto& group : all_) {
    const Diagnostic& first = group.front();
    keyed.push_back({{files.at(first.file), first.at.line, first.at.column}, &group});
  }
  std::ranges::stable_sort(keyed, {}, [](const auto& entry) { return entry.first; });
  std::vector<Diagnostic> result;
  std::set<std::pair<Place, std::string_view>> said;
  for (const auto& [place, group] : keyed) {
    // What is wrong with a definition is wrong wherever it is used.
    if (!said.emplace(place, group->front().message).second) continue;
    result.insert(result.end(), group->begin(), group->end());
    append_uses(group->front().at.source, result);
  }
  return result;
}

}  // namespace flyball
