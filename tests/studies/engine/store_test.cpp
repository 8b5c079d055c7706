#include "studies/engine/store.h"

#include <cmath>
#include <fstream>
#include <limits>

#include "blocks/hash.h"
#include "studies/file.h"
#include "tests/catch.h"
#include "tests/studies/temporary_folder.h"

using namespace flyball;
using namespace flyball::test;

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
const StoreColumns columns{{"overshoot", "time \"to\" settle"}, {"calm"}};

StoredRun stored(std::int64_t run, double metric) {
  StoredRun result{run, 0xfedcba9876543210u + static_cast<std::uint64_t>(run), {}};
  result.record.end = 0.1 * static_cast<double>(run);
  result.record.metrics = {metric, nan};
  result.record.verdicts = {{metric < 5.0, 5.0 - metric, metric, nan, metric < 5.0 ? "" : "it is too much"}};
  return result;
}

std::vector<StoredRun> all(const Store& store) {
  std::vector<StoredRun> runs;
  store.read(0, 1000, [&](const StoredRun& run) { runs.push_back(run); });
  return runs;
}

}  // namespace

TEST_CASE("A store gives back what was added, bit by bit, in order of the runs") {
  const TemporaryFolder folder;
  Store store(folder / "study.sqlite", Store::Mode::write, columns);
  StoredRun failed = stored(7, 0.1 + 0.2);
  failed.record.status = RunStatus::stopped;
  failed.record.reason = "x.y is nan at t = 1 s";
  store.add(std::vector<StoredRun>{failed, stored(2, std::numeric_limits<double>::infinity())});
  store.add(std::vector<StoredRun>{stored(3, -5e-324)});
  const auto runs = all(store);
  REQUIRE(runs.size() == 3);
  CHECK(runs[0].run == 2);
  CHECK(runs[0].key == 0xfedcba9876543212u);
  CHECK(std::isinf(runs[0].record.metrics[0]));
  CHECK(std::isnan(runs[0].record.metrics[1]));
  CHECK_FALSE(runs[0].record.verdicts[0].passed);
  CHECK(runs[0].record.verdicts[0].message == "it is too much");
  CHECK(runs[1].record.metrics[0] == -5e-324);
  CHECK(runs[2].record.metrics[0] == 0.1 + 0.2);
  CHECK(runs[2].record.status == RunStatus::stopped);
  CHECK(runs[2].record.reason == "x.y is nan at t = 1 s");
  CHECK(runs[2].record.end == 0.1 * 7);
}

TEST_CASE("A store that is opened again has its runs; other columns begin anew") {
  const TemporaryFolder folder;
  const auto file = folder / "study.sqlite";
  {
    Store store(file, Store::Mode::write, columns);
    store.add(std::vector<StoredRun>{stored(1, 1.0), stored(2, 2.0), stored(3, 3.0)});
    store.keep_text("fit.a", 17, "Kp = 1");
    store.settle();
  }
  {
    Store store(file, Store::Mode::write, columns);
    CHECK(all(store).size() == 3);
    store.add(std::vector<StoredRun>{stored(2, 9.0)});
    store.remove_from(3);
    REQUIRE(all(store).size() == 2);
    CHECK(all(store)[1].record.metrics[0] == 9.0);
    CHECK(store.text("fit.a", 17) == "Kp = 1");
    CHECK_FALSE(store.text("fit.a", 18).has_value());
  }
  CHECK(Store(file, Store::Mode::read).columns() == columns);
  CHECK(all(Store(file, Store::Mode::write, {{"other"}, {}})).empty());
}

TEST_CASE("One process writes a store, others read it meanwhile") {
  const TemporaryFolder folder;
  const auto file = folder / "study.sqlite";
  Store store(file, Store::Mode::write, columns);
  store.add(std::vector<StoredRun>{stored(1, 1.0)});
  CHECK_THROWS_WITH(Store(file, Store::Mode::write, columns),
                    (folder / "study.lock").string() + ": another process works on this study");
  CHECK(all(Store(file, Store::Mode::read)).size() == 1);
}

TEST_CASE("A hash of pieces is that of the whole") {
  Fingerprint pieces;
  for (const char* piece : {"a store ", "", "of a study"}) pieces.add(piece);
  CHECK(pieces.text() == fingerprint("a store of a study"));
  CHECK(fingerprint("a") == "fnv1a64:af63dc4c8601ec8c");  // of the test vectors of RFC 9923
}

TEST_CASE("A file that is no store is left as it is") {
  const TemporaryFolder folder;
  const auto file = folder / "study.sqlite";
  const std::string text(5000, 'x');
  std::ofstream(file) << text;
  for (const auto mode : {Store::Mode::write, Store::Mode::read}) {
    CHECK_THROWS_WITH(Store(file, mode, columns), Catch::Contains("the store of a study"));
  }
  CHECK(read_file(file) == text);
  CHECK_THROWS_WITH(Store(folder / "missing.sqlite", Store::Mode::read),
                    Catch::Contains("missing.sqlite: cannot be read: No such file or directory"));
}
