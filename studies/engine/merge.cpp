#include <fmt/format.h>

#include <limits>
#include <map>
#include <stdexcept>

#include "studies/engine/run_study.h"

namespace flyball {
namespace {

namespace fs = std::filesystem;

void require_same(const StoreColumns& columns, const StoreColumns& others, const fs::path& folder) {
  if (columns == others) return;
  throw std::invalid_argument(
      fmt::format("{}: has other metrics or requirements: it is of another study", folder.string()));
}

class Merger {
 public:
  explicit Merger(Store& store) : store_(store) {
    store.keys([&](std::int64_t run, std::uint64_t key) { keys_[run] = key; });
  }

  void add(const fs::path& folder) {
    const Store other(store_file(folder), Store::Mode::read);
    require_same(store_.columns(), other.columns(), folder);
    other.keys([&](std::int64_t run, std::uint64_t key) {
      const auto [known, is_new] = keys_.try_emplace(run, key);
      if (known->second == key) return;
      throw std::invalid_argument(
          fmt::format("{}: its run {} is another one than in the folders before it: they are of different "
                      "studies, or the study has changed between them",
                      folder.string(), run));
    });
    std::vector<StoredRun> runs;
    other.read(0, std::numeric_limits<std::int64_t>::max(), [&](const StoredRun& run) {
      runs.push_back(run);
      if (runs.size() == at_once) flush(runs);
    });
    flush(runs);
    other.texts([&](const std::string& name, std::uint64_t key, const std::string& text) {
      store_.keep_text(name, key, text);
    });
  }

 private:
  static constexpr std::size_t at_once = 1000;

  void flush(std::vector<StoredRun>& runs) {
    store_.add(runs);
    runs.clear();
  }

  Store& store_;
  std::map<std::int64_t, std::uint64_t> keys_;
};

}  // namespace

void merge_studies(const fs::path& folder, const std::vector<fs::path>& others) {
  const StoreColumns columns = Store(store_file(others.at(0)), Store::Mode::read).columns();
  if (fs::exists(store_file(folder)))
    require_same(columns, Store(store_file(folder), Store::Mode::read).columns(), folder);
  Store store(store_file(folder), Store::Mode::write, columns);
  Merger merger(store);
  for (const fs::path& other : others) merger.add(other);
  store.settle();
}

}  // namespace flyball
