#pragma once
#include "blocks/block.h"

namespace flyball {

struct Product : Block {
  static constexpr auto summary = "Multiplies and divides its inputs.";
  static constexpr std::array aliases{"Modelica.Blocks.Math.Product", "PRODUCT", "PROD_f"};
  std::string signs = text("signs", "**", "one * or / for each of the inputs u1, u2, …");
  Inputs u = inputs("u", static_cast<int>(signs.size()), "any", "factor or divisor");
  Output y = output("y", "any", "product of the inputs and of the reciprocals of divisors");

  explicit Product(Settings* settings) : Block(settings) {
    if (signs.empty() || signs.find_first_not_of("*/") != std::string::npos) {
      refuse("signs", "expected one * or / for each input, such as \"*/\", found \"" + signs + "\"");
    }
  }

  void outputs(auto& v) const {
    auto product = v.number(1.0);
    for (int k = 0; k < u.size(); ++k) {
      if (signs[k] == '*') {
        product *= v[u[k]];
      } else {
        product /= v[u[k]];
      }
    }
    v[y] = product;
  }
};

}  // namespace flyball
