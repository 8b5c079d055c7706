#include "models/read_file.h"

#include <array>
#include <cerrno>
#include <cstdio>
#include <memory>

namespace flyball {

std::optional<std::string> read_file_content(const std::string& file, std::size_t most) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(std::fopen(file.c_str(), "rb"), std::fclose);
  if (stream == nullptr) return std::nullopt;
  std::string content;
  std::array<char, 65536> chunk;
  while (const std::size_t size = std::fread(chunk.data(), 1, chunk.size(), stream.get())) {
    content.append(chunk.data(), size);
    if (content.size() > most) {
      errno = EFBIG;
      return std::nullopt;
    }
  }
  return std::ferror(stream.get()) != 0 ? std::nullopt : std::optional(std::move(content));
}

}  // namespace flyball
