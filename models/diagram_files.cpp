#include "models/diagram_files.h"

#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>

namespace flyball {

namespace fs = std::filesystem;

std::optional<std::string> content_of(const std::string& file) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(std::fopen(file.c_str(), "rb"), std::fclose);
  if (stream == nullptr) return std::nullopt;
  std::string content;
  std::array<char, 65536> chunk;
  while (const std::size_t size = std::fread(chunk.data(), 1, chunk.size(), stream.get())) {
    content.append(chunk.data(), size);
  }
  return std::ferror(stream.get()) != 0 ? std::nullopt : std::optional(std::move(content));
}

std::string path_beside(const std::string& user, std::string_view name) {
  return (fs::path(user).parent_path() / name).lexically_normal().string();
}

std::string identity_of(const std::string& file) {
  std::error_code error;
  const fs::path path = fs::weakly_canonical(fs::absolute(file, error), error);
  return error ? file : path.string();
}

}  // namespace flyball
