#include "blocks/hash.h"

#include <fmt/format.h>

namespace flyball {

void Fingerprint::add(std::string_view bytes) {
  for (const char byte : bytes) {
    hash_ ^= static_cast<unsigned char>(byte);
    hash_ *= 0x00000100000001b3;
  }
}

std::string Fingerprint::text() const { return fmt::format("fnv1a64:{:016x}", hash_); }

std::uint64_t fnv1a(std::string_view bytes) {
  Fingerprint whole;
  whole.add(bytes);
  return whole.hash();
}

std::string fingerprint(std::string_view bytes) {
  Fingerprint whole;
  whole.add(bytes);
  return whole.text();
}

}  // namespace flyball
