#pragma once
#include "blocks/block.h"

namespace flyball {

struct MathFunction : Block {
  static constexpr auto summary = "An exponential, logarithm, power or root of its input.";
  // In the order of `choices`.
  enum class Function { exp, log, power_of_10, log10, square, sqrt, reciprocal, pow, hypot };
  Function function = static_cast<Function>(option(
      "function", "exp", {"exp", "log", "10^u", "log10", "square", "sqrt", "reciprocal", "pow", "hypot"},
      "which; pow (u1 to the power of u2) and hypot (square root of u1^2 + u2^2) have two inputs"));
  bool of_two = function >= Function::pow;
  // sqrt, square, reciprocal and hypot have a dimension of their own; the others take and give numbers.
  bool of_numbers = function <= Function::log10;
  std::vector<std::string> names =
      of_two ? std::vector<std::string>{"u1", "u2"} : std::vector<std::string>{"u"};
  Inputs u = inputs(names, of_numbers ? "1" : "any", "argument");
  Output y = output("y", of_numbers ? "1" : "any", "value of the function");

  void outputs(auto& v) const { v[y] = value(v, v[u[0]]); }

 private:
  auto value(auto& v, const auto& x) const -> std::decay_t<decltype(x)> {
    switch (function) {
      case Function::exp:
        return exp(x);
      case Function::log:
        return log(x);
      case Function::power_of_10:
        return pow(v.number(10.0), x);
      case Function::log10:
        return log10(x);
      case Function::square:
        return x * x;
      case Function::sqrt:
        return sqrt(x);
      case Function::reciprocal:
        return 1.0 / x;
      case Function::pow:
        return pow(x, v[u[1]]);
      case Function::hypot:
        break;
    }
    return hypot(x, v[u[1]]);
  }
};

}  // namespace flyball
