#include "blocks/dependency.h"

#include <algorithm>
#include <bit>

namespace flyball {

Dependency Dependency::on(int slot, bool varies) {
  Dependency result;
  result.varies_ = varies;
  result.words_.resize(static_cast<std::size_t>(slot) / 64 + 1);
  result.words_.back() = std::uint64_t{1} << (slot % 64);
  return result;
}

std::vector<int> Dependency::slots() const {
  std::vector<int> result;
  for (std::size_t i = 0; i < words_.size(); ++i) {
    for (std::uint64_t word = words_[i]; word != 0; word &= word - 1) {
      result.push_back(static_cast<int>(64 * i) + std::countr_zero(word));
    }
  }
  return result;
}

void Dependency::read(const Dependency& other) {
  words_.resize(std::max(words_.size(), other.words_.size()));
  for (std::size_t i = 0; i < other.words_.size(); ++i) words_[i] |= other.words_[i];
}

Dependency& Dependency::join(const Dependency& other, bool affine) {
  read(other);
  varies_ = varies_ || other.varies_;
  affine_ = affine;
  return *this;
}

}  // namespace flyball
