#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace flyball {

/// Something wrong inside a unit or an expression, at byte `offset` of its text.
class TextError : public std::runtime_error {
 public:
  TextError(std::size_t offset, const std::string& message) : std::runtime_error(message), offset_(offset) {}

  std::size_t offset() const { return offset_; }

 private:
  std::size_t offset_;
};

}  // namespace flyball
