#include "studies/engine/run_study.h"

#include <fstream>

#include "studies/engine/slurm.h"
#include "studies/engine/write_study.h"
#include "studies/file.h"
#include "studies/shell.h"
#include "tests/catch.h"
#include "tests/studies/engine/small_studies.h"
#include "tests/studies/temporary_folder.h"

using namespace flyball;
using namespace flyball::test;

namespace {

namespace fs = std::filesystem;

/// Two cases with the same draws of x0 and the same noise, `samples` of each.
Study lag_study(int samples) {
  Study study;
  study.file = "lag_study.toml";
  study.metrics = {{"cost", "final(cost)"}, {"largest", "max(abs(x))"}};
  study.requirements = {{"small", "max(abs(x)) < 1.2"}};
  study.models.push_back(study_model(lag_model, {"final(cost)", "max(abs(x))"}, {"max(abs(x)) < 1.2"}));
  study.cases = {{"fast", {{"T", 0.2}}, "", "", {}}, {"slow", {{"T", 0.8}}, "", "", {}}};
  study.scenarios = {{"noisy", {{"deviation", 0.3}}, "", "", {}}};
  study.monte_carlo.runs = samples;
  Distribution spread;
  spread.a = 0.9;
  spread.b = 1.1;
  study.monte_carlo.spread = {{"x0", spread}};
  return study;
}

StudyOptions options_in(const fs::path& folder, int threads = 1) {
  fs::create_directories(folder);
  StudyOptions options;
  options.folder = folder;
  options.threads = threads;
  return options;
}

/// All results of a study in a folder, in one text.
std::string results(const Study& study, const StudyRun& run, const fs::path& folder) {
  REQUIRE(run.complete());
  std::string text;
  for (const fs::path& file : write_study(study, run, folder).written.files)
    text += file.filename().string() + '\n' + read_file(file);
  return text;
}

std::string whole(const Study& study, const fs::path& folder, int threads = 1) {
  return results(study, run_study(study, options_in(folder, threads), {}), folder);
}

/// Runs until so many runs more are there.
StudyRun run_some(const Study& study, StudyOptions options, std::int64_t runs) {
  std::int64_t begun = -1, now = 0;
  options.progress = [&](const StudyProgress& progress) {
    if (begun < 0) begun = progress.done;
    now = progress.done;
  };
  options.cancelled = [&] { return begun >= 0 && now - begun >= runs; };
  return run_study(study, options, {});
}

}  // namespace

TEST_CASE("A study that is finished is not run again, and its results keep their bytes") {
  const TemporaryFolder folder;
  const Study study = lag_study(10);
  const StudyRun first = run_study(study, options_in(folder / "a"), {});
  CHECK(first.runs == 20);
  CHECK(first.finished == 20);
  CHECK(first.found == 0);
  const std::string expected = results(study, first, folder / "a");
  const StudyRun second = run_study(study, options_in(folder / "a"), {});
  CHECK(second.found == 20);
  CHECK(results(study, second, folder / "a") == expected);
  CHECK(study_status(study, options_in(folder / "a")).complete());
}

TEST_CASE("A study that was ended at any run goes on, to the same bytes") {
  const TemporaryFolder folder;
  const Study study = lag_study(11);
  const std::string expected = whole(study, folder / "whole");
  const auto options = options_in(folder / "parts");
  std::int64_t before = 0;
  for (StudyRun run = run_some(study, options, 1); !run.complete(); run = run_some(study, options, 1)) {
    CHECK(run.interrupted);
    CHECK(run.found == before);
    CHECK(run.finished > before);
    before = run.finished;
    CHECK(study_status(study, options).finished == before);
  }
  CHECK(whole(study, folder / "parts") == expected);
}

TEST_CASE("A study gives the same bytes with any number of threads") {
  const TemporaryFolder folder;
  const Study study = lag_study(50);
  const std::string expected = whole(study, folder / "1");
  CHECK(whole(study, folder / "2", 2) == expected);
  CHECK(whole(study, folder / "8", 8) == expected);
}

TEST_CASE("Parts of a study that are merged give the bytes of the whole") {
  const TemporaryFolder folder;
  const Study study = lag_study(25);
  const std::string expected = whole(study, folder / "whole");
  std::vector<fs::path> parts;
  std::int64_t runs = 0;
  for (int shard = 1; shard <= 3; ++shard) {
    StudyOptions options = options_in(folder / std::to_string(shard));
    options.shard = shard;
    options.shards = 3;
    const StudyRun part = run_study(study, options, {});
    CHECK(part.complete());
    runs += part.runs;
    parts.push_back(options.folder);
  }
  CHECK(runs == 50);
  fs::create_directories(folder / "merged");
  merge_studies(folder / "merged", parts);
  const StudyRun merged = run_study(study, options_in(folder / "merged"), {});
  CHECK(merged.found == 50);
  CHECK(results(study, merged, folder / "merged") == expected);
}

TEST_CASE("Parts of different studies are not merged") {
  const TemporaryFolder folder;
  run_study(lag_study(4), options_in(folder / "a"), {});
  Study changed = lag_study(4);
  changed.cases[0].settings[0].value = 0.25;
  run_study(changed, options_in(folder / "b"), {});
  Study other = lag_study(4);
  other.metrics.pop_back();
  other.models[0].metrics.pop_back();
  run_study(other, options_in(folder / "c"), {});
  fs::create_directories(folder / "merged");
  CHECK_THROWS_WITH(merge_studies(folder / "merged", {folder / "a", folder / "b"}),
                    Catch::Contains("its run 0 is another one than in the folders before it"));
  CHECK_THROWS_WITH(merge_studies(folder / "merged", {folder / "a", folder / "c"}),
                    Catch::Contains("has other metrics or requirements"));
}

TEST_CASE("What has changed in a study is run again, and nothing else") {
  const TemporaryFolder folder;
  Study study = lag_study(8);
  run_study(study, options_in(folder / "a"), {});
  study.cases[1].settings[0].value = 0.7;
  CHECK(study_status(study, options_in(folder / "a")).finished == 8);
  const StudyRun again = run_study(study, options_in(folder / "a"), {});
  CHECK(again.found == 8);
  CHECK(again.finished == 16);
  CHECK(results(study, again, folder / "a") == whole(study, folder / "b"));
  study.cases.pop_back();
  CHECK(results(study, run_study(study, options_in(folder / "a"), {}), folder / "a") ==
        whole(study, folder / "c"));
}

TEST_CASE("A run that fails is a row with its reason") {
  const TemporaryFolder folder;
  Study study = lag_study(4);
  study.cases[1].settings[0].value = -1.0;
  const StudyRun run = run_study(study, options_in(folder / "a"), {});
  CHECK(run.complete());
  CHECK(run.failed == 4);
  const StudyResults written = write_study(study, run, folder / "a");
  CHECK(written.failed == 4);
  const std::string csv = read_file(folder / "a" / "runs.csv");
  CHECK(csv.find(",stopped,nan,nan,0,nan,0,\"T is -1, outside its range [0.01, 100]\"\n") !=
        std::string::npos);
  CHECK(written.violations.find("T is -1") != std::string::npos);
}

TEST_CASE("A requirement that does not hold is told with its worst run") {
  const TemporaryFolder folder;
  Study study = lag_study(3);
  study.scenarios[0].settings = {{"deviation", 0.0}};
  study.cases[1].settings.push_back({"x0", 1.5});
  const StudyRun run = run_study(study, options_in(folder / "a"), {});
  const StudyResults written = write_study(study, run, folder / "a");
  // x falls from x0, so that x0 is the largest; the first of three equal runs is told.
  CHECK(written.violations.find(
            "requirement small (max(abs(x)) < 1.2): broken in 3 of 6 runs, worst in case slow, "
            "sample 0, run 3: ") == 0);
}

TEST_CASE("Cases take what a search has found, which is kept") {
  const TemporaryFolder folder;
  Study study = lag_study(4);
  study.fits.emplace_back();
  study.fits[0].name = "best";
  study.fits[0].parameters = {{"T", 0.1, 1.0, {}, 0.0}};
  study.cases[0] = {"fitted", {}, "fit.best", "", {}};
  static int searched = 0;
  searched = 0;
  Searches searches;
  searches.fit = [](const Study&, const FitDefinition& fit, Evaluator&, int,
                    const std::function<bool(int, double)>&) {
    ++searched;
    FitResult result;
    result.name = fit.name;
    result.parameters.push_back({"T", "s", 0.5, 0.25, 0.0, false});
    return result;
  };
  CHECK(study_status(study, options_in(folder / "a")).searches == std::vector<std::string>{"fit.best"});
  const StudyRun run = run_study(study, options_in(folder / "a"), searches);
  REQUIRE(run.complete());
  CHECK(run.cases[0].settings == std::vector<Setting>{{"T", 0.25}});
  run_study(study, options_in(folder / "a"), searches);
  CHECK(searched == 1);
  study.fits[0].max_iterations = 50;
  run_study(study, options_in(folder / "a"), searches);
  CHECK(searched == 2);
}

TEST_CASE("The script of a cluster quotes its names and joins what it runs") {
  const std::string script = slurm_script({"my study.toml", "out", "/home/a b", "flyball", 8, 2});
  for (const char* line :
       {"#SBATCH --job-name=my_study\n", "#SBATCH --array=1-8\n", "#SBATCH --cpus-per-task=2\n",
        "cd -- '/home/a b'\n",
        "exec flyball study 'my study.toml' --output out/part-\"$part\" --shard \"$part/8\"",
        "  flyball study merge out out/part-*\n",
        "  exec flyball study 'my study.toml' --output out --threads"}) {
    INFO(line);
    CHECK(script.find(line) != std::string::npos);
  }
  CHECK(shell_quoted("it's") == "'it'\\''s'");
}
