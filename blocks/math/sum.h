#pragma once
#include "blocks/block.h"

namespace flyball {

struct Sum : Block {
  static constexpr auto summary = "Adds and subtracts its inputs.";
  static constexpr std::array aliases{"Modelica.Blocks.Math.Add", "SUMMATION", "BIGSOM_f"};
  std::string signs = text("signs", "++", "one + or - for each of the inputs u1, u2, …");
  Inputs u = inputs("u", static_cast<int>(signs.size()), "any", "term");
  Output y = output("y", "any", "sum of the inputs with their signs");

  std::vector<double> sign;

  explicit Sum(Settings* settings) : Block(settings) {
    for (const char c : signs) sign.push_back(c == '-' ? -1.0 : 1.0);
    if (signs.empty() || signs.find_first_not_of("+-") != std::string::npos) {
      refuse("signs", "expected one + or - for each input, such as \"+-\", found \"" + signs + "\"");
    }
  }

  void outputs(auto& v) const {
    auto total = v.number(0.0);
    for (int k = 0; k < u.size(); ++k) total += sign[k] * v[u[k]];
    v[y] = total;
  }
};

}  // namespace flyball
