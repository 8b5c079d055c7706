#include "studies/file.h"

#include <sys/resource.h>

#include <csignal>

#include "tests/catch.h"
#include "tests/studies/temporary_folder.h"

using namespace flyball;
using flyball::test::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

/// While it lives, no file may grow beyond `bytes`: a write fails as on a full disk.
class SmallFiles {
 public:
  explicit SmallFiles(rlim_t bytes) : old_handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &old_);
    const rlimit limit{bytes, old_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~SmallFiles() {
    setrlimit(RLIMIT_FSIZE, &old_);
    std::signal(SIGXFSZ, old_handler_);
  }

 private:
  rlimit old_ = {};
  void (*old_handler_)(int);
};

std::string message_of(auto&& action) {
  try {
    action();
  } catch (const OutputError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace

TEST_CASE("File: what is written is there, and nothing else") {
  const TemporaryFolder folder;
  const std::string content("first\nsecond\0third", 18);
  write_file(folder / "a.csv", content);
  CHECK(read_file(folder / "a.csv") == content);
  write_file(folder / "a.csv", "new");
  CHECK(read_file(folder / "a.csv") == "new");
  CHECK(folder.files() == 1);
}

TEST_CASE("File: a write that fails half way leaves the old content and nothing else") {
  const TemporaryFolder folder;
  write_file(folder / "a.csv", "old");
  {
    const SmallFiles limit(1000);
    const std::string message = message_of([&] { write_file(folder / "a.csv", std::string(100000, 'x')); });
    CHECK(message == (folder / "a.csv").string() + ": cannot be written: File too large");
  }
  CHECK(read_file(folder / "a.csv") == "old");
  CHECK(folder.files() == 1);
}

TEST_CASE("File: a folder that is none, or is missing, is named with the reason") {
  const TemporaryFolder folder;
  write_file(folder / "file", "x");
  const fs::path below = folder / "file/a.csv", missing = folder / "missing/a.csv";
  CHECK(message_of([&] { write_file(below, "x"); }) ==
        below.string() + ": cannot be written: Not a directory");
  CHECK(message_of([&] { require_writable(missing); }) ==
        missing.string() + ": cannot be written: No such file or directory");
  CHECK(read_file(folder / "file") == "x");
}

TEST_CASE("File: asking whether a file can be written leaves no trace") {
  const TemporaryFolder folder;
  write_file(folder / "a.csv", "old");
  require_writable(folder / "a.csv");
  require_writable(folder / "b.csv");
  CHECK(read_file(folder / "a.csv") == "old");
  CHECK(folder.files() == 1);
}

TEST_CASE("File: a link stays a link, and a file keeps its mode") {
  const TemporaryFolder folder;
  write_file(folder / "target", "old");
  fs::permissions(folder / "target", fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink("target", folder / "link");
  write_file(folder / "link", "new");
  CHECK(fs::is_symlink(folder / "link"));
  CHECK(read_file(folder / "target") == "new");
  CHECK(fs::status(folder / "target").permissions() == (fs::perms::owner_read | fs::perms::owner_write));
}

TEST_CASE("File: devices and folders are not replaced") {
  const TemporaryFolder folder;
  fs::create_directory(folder / "a.csv");
  CHECK(message_of([&] { write_file(folder / "a.csv", "x"); }) ==
        (folder / "a.csv").string() + ": cannot be written: Is a directory");
  CHECK(message_of([&] { write_file("/dev/null", "x"); }) ==
        "/dev/null: cannot be written: not a regular file");
  CHECK(fs::is_character_file("/dev/null"));
}

TEST_CASE("File: what cannot be read is named with the reason") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH(read_file(folder / "none.toml"),
                    (folder / "none.toml").string() + ": cannot be read: No such file or directory");
  CHECK_THROWS_WITH(read_file(folder / "."), Catch::Contains("Is a directory"));
}
