#pragma once

#include <filesystem>
#include <string>

#include "studies/language/study.h"
#include "tests/catch.h"
#include "tests/source_dir.h"

namespace flyball::test {

/// Studies of tests stand beside the folder `parts`, where their models are.
inline std::filesystem::path study_folder() {
  return std::filesystem::path(source_dir()) / "tests" / "studies" / "broken";
}

/// A study that must be right.
inline Study study_of(const std::string& text) {
  Diagnostics diagnostics((study_folder() / "study.toml").string());
  auto study = read_study(text, diagnostics);
  for (const Diagnostic& diagnostic : diagnostics.sorted()) UNSCOPED_INFO(to_string(diagnostic));
  REQUIRE(study.has_value());
  return *std::move(study);
}

/// A study of the servo with these further lines.
inline Study servo_study(const std::string& sections) {
  return study_of("flyball = 1\n[study]\nmodel = \"parts/servo.toml\"\n" + sections);
}

}  // namespace flyball::test
