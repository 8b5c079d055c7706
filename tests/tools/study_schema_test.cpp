// The schema of study files, judged by the schema validator of Python.
#include <cstdlib>
#include <filesystem>

#include "studies/file.h"
#include "tests/catch.h"
#include "tests/source_dir.h"
#include "tests/studies/temporary_folder.h"
#include "tools/schema.h"

using namespace flyball;

TEST_CASE("the schema of studies accepts what is shipped, and refuses what no study has") {
  const test::TemporaryFolder folder;
  const std::filesystem::path sources = source_dir();
  write_file(folder / "schema.json", study_schema());
  // By the environment, so that no shell sees what stands in a path.
  setenv("SCHEMA", (folder / "schema.json").c_str(), 1);
  setenv("SOURCES", sources.c_str(), 1);
  CHECK(std::system("/usr/bin/python3 \"$SOURCES/tests/tools/study_schema.py\" \"$SCHEMA\" \"$SOURCES\" "
                    "\"$SOURCES/tests/studies/everything.toml\"") == 0);
}
