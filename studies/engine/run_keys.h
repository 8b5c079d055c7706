#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "studies/engine/evaluator.h"

namespace flyball {

/// Hashes of all that the record of a run follows from: version, models with the files that they use, metrics
/// and requirements with theirs, settings and seeds of the whole group. A run whose key has not changed need
/// not be run again.
class RunKeys {
 public:
  explicit RunKeys(const Study& study);

  /// One for each run of a group.
  std::vector<std::uint64_t> of(std::span<const RunRequest> group);
  /// Of a fit or a front: of its definition and of all that a run depends on.
  std::uint64_t of(const FitDefinition& fit);
  std::uint64_t of(const ParetoDefinition& front);

 private:
  void append(std::string& text, std::span<const Setting> settings);
  void append(std::string& text, const std::vector<Sought>& parameters);
  std::string files_named_in(const std::string& text);

  const Study& study_;
  std::string study_folder_;
  std::vector<std::string> models_;           // hash of each, as text
  std::map<std::string, std::string> files_;  // hash of each file that was looked at; empty: there is none
};

}  // namespace flyball
