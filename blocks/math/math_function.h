#pragma once
#include "blocks/block.h"

namespace flyball {

struct MathFunction : Block {
  static constexpr auto summary = "An exponential, logarithm, power, root or remainder.";
  // In the order of `choices`.
  enum class Function { exp, log, power_of_10, log10, square, sqrt, reciprocal, pow, hypot, rem, mod };
  Function function = static_cast<Function>(option(
      "function", "exp",
      {"exp", "log", "10^u", "log10", "square", "sqrt", "reciprocal", "pow", "hypot", "rem", "mod"},
      "which; from pow on with inputs u1 and u2: power, hypotenuse, remainder of u1/u2 rounded to 0 (rem), "
      "rounded down (mod)"));
  bool of_numbers = function <= Function::log10;
  bool of_two = function >= Function::pow;
  bool divides = function >= Function::rem;
  std::vector<std::string> names =
      of_two ? std::vector<std::string>{"u1", "u2"} : std::vector<std::string>{"u"};
  Inputs u = inputs(names, of_numbers ? "1" : "any", "argument");
  Output y = output("y", of_numbers ? "1" : "any", "value of the function");
  // A remainder jumps where the whole part of its quotient does.
  Held whole = divides ? held("whole", 0.0, "1", "whole part of the quotient") : Held{};
  Crossing up = crossing_if(divides, "up", Direction::rising, "the quotient rises to the next whole part");
  Crossing down = crossing_if(divides, "down", Direction::falling, "the quotient falls to the one before");

  void outputs(auto& v) const { v[y] = value(v, v[u[0]]); }
  void crossings(auto& v) const {
    if (!divides) return;
    const auto quotient = v[u[0]] / v[u[1]];
    v[up] = quotient - (v[whole] + width(v, v[whole] + 1.0));
    v[down] =
        function == Function::mod ? quotient - v[whole] : quotient - (v[whole] - width(v, 1.0 - v[whole]));
  }
  void on_crossing(Crossing which, auto& v) const {
    // One further at least, whatever the rounding of the quotient says.
    const auto found = whole_part(v[u[0]] / v[u[1]], v.number(0.0));
    v.next(whole) = which == up ? max(v[whole] + 1.0, found) : min(v[whole] - 1.0, found);
  }

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
        return hypot(x, v[u[1]]);
      default:
        return x - v[whole] * v[u[1]];
    }
  }
  /// From a whole part to the next: 1, but 0 where rounding towards 0 makes the part around 0 twice as wide.
  auto width(auto& v, auto away) const {
    return function == Function::mod ? v.number(1.0) : clamp(away, v.number(0.0), v.number(1.0));
  }
  template <class T>
  T whole_part(const T& quotient, const T& zero) const {
    if (function == Function::mod) return floor(quotient);
    return max(floor(quotient), zero) + min(-floor(-quotient), zero);
  }
};

}  // namespace flyball
