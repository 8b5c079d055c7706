#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace flyball {

/// 64-bit FNV-1a (G. Fowler, L. C. Noll, K.-P. Vo, RFC 9923): finds accidental changes, not forgeries.
std::uint64_t fnv1a(std::string_view bytes);

/// "fnv1a64:af63dc4c8601ec8c"
std::string fingerprint(std::string_view bytes);

/// The same of bytes that come piece by piece.
class Fingerprint {
 public:
  void add(std::string_view bytes);
  std::uint64_t hash() const { return hash_; }
  std::string text() const;

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325;
};

}  // namespace flyball
