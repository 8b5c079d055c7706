#include "blocks/hash.h"

#include <fmt/format.h>

namespace flyball {

std::uint64_t fnv1a(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char byte : bytes) {
    hash ^= static_cast<unsigned char>(byte);
    hash *= 0x00000100000001b3;
  }
  return hash;
}

std::string fingerprint(std::string_view bytes) { return fmt::format("fnv1a64:{:016x}", fnv1a(bytes)); }

}  // namespace flyball
