#pragma once
#include "blocks/block.h"

namespace flyball {

struct TrigonometricFunction : Block {
  static constexpr auto summary = "A trigonometric or hyperbolic function of its input.";
  static constexpr std::array aliases{"TrigFun"};
  // In the order of `choices`.
  enum class Function { sin, cos, tan, asin, acos, atan, sinh, cosh, tanh, atan2 };
  Function function = static_cast<Function>(option(
      "function", "sin", {"sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "atan2"},
      "which; atan2 has the inputs u1 (ordinate) and u2 (abscissa)"));
  bool of_angle = function <= Function::tan;
  bool to_angle = function == Function::atan2 || (function >= Function::asin && function <= Function::atan);
  std::vector<std::string> names =
      function == Function::atan2 ? std::vector<std::string>{"u1", "u2"} : std::vector<std::string>{"u"};
  Inputs u = inputs(names, of_angle ? "rad" : function == Function::atan2 ? "any" : "1", "argument");
  Output y = output("y", to_angle ? "rad" : "1", "value of the function");

  void outputs(auto& v) const {
    const auto& x = v[u[0]];
    switch (function) {
      case Function::sin:
        v[y] = sin(x);
        break;
      case Function::cos:
        v[y] = cos(x);
        break;
      case Function::tan:
        v[y] = tan(x);
        break;
      case Function::asin:
        v[y] = asin(x);
        break;
      case Function::acos:
        v[y] = acos(x);
        break;
      case Function::atan:
        v[y] = atan(x);
        break;
      case Function::sinh:
        v[y] = sinh(x);
        break;
      case Function::cosh:
        v[y] = cosh(x);
        break;
      case Function::tanh:
        v[y] = tanh(x);
        break;
      case Function::atan2:
        v[y] = atan2(x, v[u[1]]);
        break;
    }
  }
};

}  // namespace flyball
