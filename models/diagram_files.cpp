#include "models/diagram_files.h"

#include <filesystem>

namespace flyball {

namespace fs = std::filesystem;

std::string path_beside(const std::string& user, std::string_view name) {
  return (fs::path(user).parent_path() / name).lexically_normal().string();
}

std::string identity_of(const std::string& file) {
  std::error_code error;
  const fs::path path = fs::weakly_canonical(fs::absolute(file, error), error);
  return error ? file : path.string();
}

}  // namespace flyball
