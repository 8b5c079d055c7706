#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "studies/engine/evaluator.h"

namespace flyball {

/// A finished run, as it is kept.
struct StoredRun {
  std::int64_t run = 0;   // its number in the table of runs
  std::uint64_t key = 0;  // a hash of all that its record follows from
  RunRecord record;       // without a log
};

/// What the rows of a store have, besides how the run ended.
struct StoreColumns {
  std::vector<std::string> metrics;
  std::vector<std::string> requirements;

  bool operator==(const StoreColumns&) const = default;
};

/// The finished runs of a study, in one SQLite file. What `add` has returned from survives the end of the
/// process at any moment; after a loss of power the last of it may be missing, and the rest is whole. One
/// process writes, others may read meanwhile. All throw OutputError (FileError where a file cannot be read).
class Store {
 public:
  enum class Mode { write, read };

  /// Opens a store; to write, it is created where there is none, and emptied where its columns are others.
  /// Throws at once where another process writes, and where the file is something else.
  Store(const std::filesystem::path& file, Mode mode, const StoreColumns& columns = {});
  ~Store();
  Store(Store&&) noexcept;

  const StoreColumns& columns() const;

  /// In one transaction. A run that is there is replaced.
  void add(std::span<const StoredRun> runs);
  /// Calls `each` with the number and key of all runs, in order of their numbers.
  void keys(const std::function<void(std::int64_t, std::uint64_t)>& each) const;
  /// Calls `each` with the runs from `first` to `last` - 1 that are there, in order of their numbers.
  void read(std::int64_t first, std::int64_t last, const std::function<void(const StoredRun&)>& each) const;
  /// How many runs there are that ended so.
  std::int64_t count(RunStatus status) const;
  /// Removes the runs from `first` on: a table that has become shorter.
  void remove_from(std::int64_t first);

  /// A text that is kept beside the runs, with the hash of what it follows from; nothing where there is none
  /// with this hash.
  std::optional<std::string> text(const std::string& name, std::uint64_t key) const;
  void keep_text(const std::string& name, std::uint64_t key, const std::string& text);
  /// Calls `each` with all texts, in order of their names.
  void texts(const std::function<void(const std::string&, std::uint64_t, const std::string&)>& each) const;

  /// Writes all into the one file, so that nothing stands beside it.
  void settle();

 private:
  class Database;
  std::unique_ptr<Database> database_;
};

}  // namespace flyball
