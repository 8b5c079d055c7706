#pragma once
#include "blocks/block.h"

namespace flyball {

struct MinMax : Block {
  static constexpr auto summary = "The least or the greatest of its inputs.";
  static constexpr std::array aliases{"MAXMIN"};
  bool greatest = option("function", "min", {"min", "max"}, "which") == 1;
  int width = count("inputs", 2, 1, 1000, "number of inputs");
  Inputs u = inputs("u", width, "any", "signal");
  Output y = output("y", "any", "the least or the greatest signal");
  // Relation k says that input k + 2 goes beyond all inputs before it.
  Relations beyond = relations_each("beyond", width - 1, "the next input goes beyond all inputs before it");

  // Compared with the extreme itself, not with what other bits select: bits of one block settle together.
  void relations(auto& v) const {
    auto extreme = v[u[0]];
    for (int k = 0; k < beyond.size(); ++k) {
      const auto& next = v[u[k + 1]];
      v[beyond[k]] = greatest ? next - extreme : extreme - next;
      if (k + 1 < beyond.size()) extreme = greatest ? max(extreme, next) : min(extreme, next);
    }
  }
  void outputs(auto& v) const {
    auto extreme = v[u[0]];
    for (int k = 0; k < beyond.size(); ++k) extreme = select(v.on(beyond[k]), v[u[k + 1]], extreme);
    v[y] = extreme;
  }
};

}  // namespace flyball
