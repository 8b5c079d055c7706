#pragma once
#include "blocks/block.h"

namespace flyball {

struct Divide : Block {
  static constexpr auto summary = "Divides one signal by another.";
  Input u1 = input("u1", "any", "dividend");
  Input u2 = input("u2", "any", "divisor");
  Output y = output("y", "any", "u1 over u2");

  void outputs(auto& v) const { v[y] = v[u1] / v[u2]; }
};

}  // namespace flyball
