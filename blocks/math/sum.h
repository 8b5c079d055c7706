#pragma once
#include "blocks/block.h"

namespace flyball {

struct Sum : Block {
  static constexpr auto summary = "Adds and subtracts its inputs.";
  std::string signs = text("signs", "++", "one + or - for each of the inputs u1, u2, …");
  Inputs u = inputs("u", static_cast<int>(signs.size()), "any", "term");
  Output y = output("y", "any", "sum of the inputs with their signs");

  explicit Sum(Settings* settings) : Block(settings) {
    if (signs.empty() || signs.find_first_not_of("+-") != std::string::npos) {
      refuse("signs", "expected one + or - for each input, such as \"+-\", found \"" + signs + "\"");
    }
  }

  void outputs(auto& v) const {
    auto total = v.number(0.0);
    for (int k = 0; k < u.size(); ++k) {
      if (signs[k] == '+') {
        total += v[u[k]];
      } else {
        total -= v[u[k]];
      }
    }
    v[y] = total;
  }
};

}  // namespace flyball
