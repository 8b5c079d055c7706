#include "studies/engine/run_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <stdexcept>

#include "studies/engine/run_keys.h"

namespace flyball {
namespace {

namespace fs = std::filesystem;

/// A line each: name, tab, value.
std::string to_text(const std::vector<Setting>& settings) {
  std::string text;
  for (const Setting& setting : settings)
    text += fmt::format("{}\t{}\n", setting.name, std::get<double>(setting.value));
  return text;
}

std::vector<Setting> to_settings(std::string_view text) {
  std::vector<Setting> settings;
  while (!text.empty()) {
    const std::size_t tab = text.find('\t'), end = text.find('\n');
    double value = 0.0;
    std::from_chars(text.data() + tab + 1, text.data() + end, value);
    settings.push_back({std::string(text.substr(0, tab)), value});
    text.remove_prefix(end + 1);
  }
  return settings;
}

/// Under which name a case finds its settings in the store.
std::string kept_name(const std::string& from, const std::string& pick) {
  return pick.empty() ? from : from + ' ' + pick;
}

/// Finds what cases take from fits and fronts, or takes what was found before.
class CaseFinder {
 public:
  CaseFinder(const Study& study, RunKeys& keys, const Store* known) : study_(study), known_(known) {
    for (const FitDefinition& fit : study.fits) keys_["fit." + fit.name] = keys.of(fit);
    for (const ParetoDefinition& front : study.fronts) keys_["pareto." + front.name] = keys.of(front);
  }

  /// Searches whose answers, or one of them, are not there.
  std::vector<std::string> missing() const {
    std::vector<std::string> names;
    for (const FitDefinition& fit : study_.fits) {
      if (!text("fit." + fit.name)) names.push_back("fit." + fit.name);
    }
    for (const ParetoDefinition& front : study_.fronts) {
      const std::vector<std::string> picks = picks_of(front);
      const auto is_there = [&](const std::string& pick) {
        return text(kept_name("pareto." + front.name, pick)).has_value();
      };
      if (!std::ranges::all_of(picks, is_there)) names.push_back("pareto." + front.name);
    }
    return names;
  }

  void keep(Store& store, const FitResult& fit) const {
    const std::string name = "fit." + fit.name;
    store.keep_text(name, keys_.at(name), to_text(fit.settings()));
  }

  void keep(Store& store, const ParetoDefinition& definition, ParetoResult front) const {
    const std::string name = "pareto." + definition.name;
    for (const std::string& pick : picks_of(definition)) {
      if (!pick.empty()) front.picked = pick_point(front, pick, definition.weights);
      store.keep_text(kept_name(name, pick), keys_.at(name), to_text(front.settings()));
    }
  }

  /// The cases with what is there.
  std::vector<Choice> cases() const {
    std::vector<Choice> cases = study_.cases;
    for (Choice& choice : cases) {
      if (choice.from.empty()) continue;
      std::vector<Setting> settings = to_settings(text(kept_name(choice.from, choice.pick)).value_or(""));
      // What the case sets itself counts more.
      settings.insert(settings.end(), choice.settings.begin(), choice.settings.end());
      choice.settings = std::move(settings);
    }
    return cases;
  }

 private:
  std::optional<std::string> text(const std::string& name) const {
    const auto key = keys_.find(name.substr(0, name.find(' ')));
    if (known_ == nullptr || key == keys_.end()) return std::nullopt;
    return known_->text(name, key->second);
  }

  /// What cases ask of a front, and its own choice.
  std::vector<std::string> picks_of(const ParetoDefinition& front) const {
    std::vector<std::string> picks{""};
    for (const Choice& choice : study_.cases) {
      if (choice.from == "pareto." + front.name && !choice.pick.empty()) picks.push_back(choice.pick);
    }
    return picks;
  }

  const Study& study_;
  const Store* known_;
  std::map<std::string, std::uint64_t> keys_;
};

/// The runs of one part of a study, by groups of the whole: what a run gives depends on no part.
class Part {
 public:
  Part(const RunTable& table, const StudyOptions& options) : table_(table), options_(options) {}

  std::int64_t groups() const {
    const std::int64_t all = (table_.size() + group_size - 1) / group_size;
    return (all + options_.shards - options_.shard) / options_.shards;
  }
  /// The first run of a group of this part.
  std::int64_t first(std::int64_t group) const {
    return (group * options_.shards + options_.shard - 1) * group_size;
  }
  std::vector<RunRequest> requests(std::int64_t group) const {
    std::vector<RunRequest> requests;
    const std::int64_t end = std::min(first(group) + group_size, table_.size());
    for (std::int64_t run = first(group); run < end; ++run) requests.push_back(table_.request(run));
    return requests;
  }

 private:
  const RunTable& table_;
  const StudyOptions& options_;
};

/// Which groups of a part are missing, and the keys of its runs.
struct Missing {
  std::vector<std::int64_t> groups;
  std::vector<std::uint64_t> keys;  // `group_size` for each group of the part
  std::int64_t runs = 0, finished = 0;

  Missing(const Part& part, RunKeys& run_keys, const Store* known, std::int64_t size)
      : keys(static_cast<std::size_t>(part.groups() * group_size)) {
    std::vector<std::uint64_t> there(static_cast<std::size_t>(size));
    if (known != nullptr) {
      known->keys([&](std::int64_t run, std::uint64_t key) {
        if (run < size) there[run] = key;
      });
    }
    for (std::int64_t group = 0; group < part.groups(); ++group) {
      const std::vector<std::uint64_t> wanted = run_keys.of(part.requests(group));
      std::ranges::copy(wanted, keys.begin() + group * group_size);
      runs += static_cast<std::int64_t>(wanted.size());
      if (std::equal(wanted.begin(), wanted.end(), there.begin() + part.first(group))) {
        finished += static_cast<std::int64_t>(wanted.size());
      } else {
        groups.push_back(group);
      }
    }
  }
};

/// A process that was killed while it wrote leaves parts of files (write_file). Nobody else writes here.
void remove_parts(const fs::path& folder) {
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with('.') && name.ends_with(".part")) fs::remove(entry.path(), error);
  }
}

/// Throws std::invalid_argument where this program has no such search.
void require(bool there, const std::string& name) {
  if (!there) throw std::invalid_argument(name + ": this program does not search");
}

class StudyRunner {
 public:
  StudyRunner(const Study& study, const StudyOptions& options, const Searches& searches)
      : study_(study),
        options_(options),
        searches_(searches),
        evaluator_(study.models),
        keys_(study),
        store_(store_file(options.folder), Store::Mode::write, store_columns(study)) {}

  StudyRun run() {
    remove_parts(options_.folder);
    const CaseFinder finder(study_, keys_, &store_);
    StudyRun result;
    result.searches = finder.missing();
    while (!result.searches.empty() && !cancelled()) {
      search(result.searches.front(), finder);
      result.searches = finder.missing();
    }
    result.cases = finder.cases();
    if (result.searches.empty()) run_table(result);
    result.failed = store_.count(RunStatus::stopped);
    result.interrupted = cancelled();
    store_.settle();
    return result;
  }

 private:
  bool cancelled() const { return options_.cancelled && options_.cancelled(); }

  void tell(StudyProgress progress) const {
    if (options_.progress) options_.progress(progress);
  }

  void search(const std::string& name, const CaseFinder& finder) {
    for (const FitDefinition& fit : study_.fits) {
      if (name != "fit." + fit.name) continue;
      require(searches_.fit != nullptr, name);
      const auto progress = [&](int iteration, double) {
        tell({name, static_cast<double>(iteration) / fit.max_iterations});
        return !cancelled();
      };
      const FitResult result = searches_.fit(study_, fit, evaluator_, options_.threads, progress);
      if (cancelled()) return;
      if (searches_.fitted) searches_.fitted(result);
      finder.keep(store_, result);
    }
    for (const ParetoDefinition& front : study_.fronts) {
      if (name != "pareto." + front.name) continue;
      require(searches_.front != nullptr, name);
      const auto progress = [&](double part) {
        tell({name, part});
        return !cancelled();
      };
      const ParetoResult result = searches_.front(study_, front, evaluator_, options_.threads, progress);
      if (cancelled()) return;
      if (searches_.front_found) searches_.front_found(result);
      finder.keep(store_, front, result);
    }
  }

  void run_table(StudyRun& result) {
    const RunTable table(study_, result.cases);
    const Part part(table, options_);
    const Missing missing(part, keys_, &store_, table.size());
    store_.remove_from(table.size());
    result.runs = missing.runs;
    result.found = result.finished = missing.finished;
    const auto requests = [&](std::int64_t k) { return part.requests(missing.groups[k]); };
    const auto keep = [&](std::vector<FinishedGroup>& finished) {
      std::vector<StoredRun> runs;
      for (FinishedGroup& group : finished) {
        const std::int64_t number = missing.groups[group.number], first = part.first(number);
        for (std::size_t k = 0; k < group.records.size(); ++k) {
          const auto run = static_cast<std::int64_t>(k);
          runs.push_back({first + run, missing.keys[number * group_size + run], std::move(group.records[k])});
        }
      }
      store_.add(runs);
      result.finished += static_cast<std::int64_t>(runs.size());
      const double done = static_cast<double>(result.finished) / static_cast<double>(result.runs);
      tell({"runs", done, result.finished, result.runs});
    };
    EvaluatorOptions options;
    options.threads = options_.threads;
    options.cancelled = options_.cancelled;
    evaluator_.run_groups(static_cast<std::int64_t>(missing.groups.size()), requests, keep, options);
  }

  const Study& study_;
  const StudyOptions& options_;
  const Searches& searches_;
  Evaluator evaluator_;
  RunKeys keys_;
  Store store_;
};

}  // namespace

fs::path store_file(const fs::path& folder) { return folder / "study.sqlite"; }

StoreColumns store_columns(const Study& study) {
  StoreColumns columns;
  for (const auto& [name, text] : study.metrics) columns.metrics.push_back(name);
  for (const auto& [name, text] : study.requirements) columns.requirements.push_back(name);
  return columns;
}

StudyRun run_study(const Study& study, const StudyOptions& options, const Searches& searches) {
  return StudyRunner(study, options, searches).run();
}

StudyRun study_status(const Study& study, const StudyOptions& options) {
  std::optional<Store> store;
  if (fs::exists(store_file(options.folder))) {
    store.emplace(store_file(options.folder), Store::Mode::read);
    // With other columns no run is of this study.
    if (store->columns() != store_columns(study)) store.reset();
  }
  const Store* known = store ? &*store : nullptr;
  RunKeys keys(study);
  const CaseFinder finder(study, keys, known);
  StudyRun result;
  result.cases = finder.cases();
  result.searches = finder.missing();
  const RunTable table(study, result.cases);
  const Part part(table, options);
  const Missing missing(part, keys, known, table.size());
  result.runs = missing.runs;
  result.found = result.finished = missing.finished;
  if (known != nullptr) result.failed = known->count(RunStatus::stopped);
  return result;
}

}  // namespace flyball
