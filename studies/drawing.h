#pragma once

#include <filesystem>
#include <string>

namespace flyball {

/// What became of a figure.
struct Drawing {
  bool drawn = false;
  std::string warning;  // why not
};

/// Gives what another program drew into `part` the name `figure`, and removes `part`. The program may have
/// met a full disk without a word, so a drawing without its end is refused. Throws OutputError.
void keep_drawing(const std::filesystem::path& part, const std::filesystem::path& figure);

}  // namespace flyball
