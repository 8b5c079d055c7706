#pragma once
#include <algorithm>
#include <type_traits>

#include "blocks/block.h"

namespace flyball {

/// `above()` where the bit is on, else `below()`; a plain truth value of numbers asks for one of them only.
auto select_lazily(auto bit, auto&& above, auto&& below) {
  constexpr bool has_value = !std::is_same_v<decltype(below()), Dimensional>;
  if constexpr (has_value && std::is_same_v<decltype(bit), bool>) {
    return bit ? above() : below();
  } else {
    return select(bit, above(), below());
  }
}

/// One axis of a table. Each place at which the table has a kink or a jump is a relation, so that no step of
/// an integrator passes over it, and the pieces between them are found by their bits: by value where the
/// signal jumps, however far, and frozen during a step.
struct TableAxis {
  // In the order of `method_names`.
  enum class Method { linear, nearest, flat };
  static std::vector<std::string> method_names() { return {"linear", "nearest", "flat"}; }

  Coefficients breakpoints;
  Method method;
  bool clips;  // beyond the ends: the value there, else the line of the last interval
  Relations passed;

  /// How many kinks or jumps there are between n breakpoints.
  static int edges(int n, Method method, bool clips) {
    return std::max(method != Method::linear ? n - 1 : clips ? n : n - 2, 0);
  }

  void relations(auto& v, Input u) const {
    // A signal on a breakpoint belongs to the piece above.
    for (int k = 0; k < passed.size(); ++k) v[passed[k]] = v[u] - edge(v, k) + smallest;
  }

  /// The value at u of the table whose value at breakpoint k is `value(k)`.
  auto interpolate(auto& v, Input u, auto&& value) const { return find(v, u, value, 0, passed.size()); }

 private:
  Param x(int k) const { return breakpoints.entries()[k].param; }
  int last() const { return breakpoints.columns() - 1; }

  auto edge(auto& v, int k) const -> decltype(v.number(0.0)) {
    if (method == Method::nearest) return (v[x(k)] + v[x(k + 1)]) / 2.0;
    return v[x(method == Method::linear && clips ? k : k + 1)];
  }
  /// Between pieces `low` and `high`, by halving: bits of lower edges are on where those of higher ones are.
  auto find(auto& v, Input u, auto& value, int low, int high) const -> decltype(v.number(0.0)) {
    if (low == high) return piece(v, u, value, low);
    const int middle = (low + high) / 2;
    return select_lazily(
        v.on(passed[middle]), [&] { return find(v, u, value, middle + 1, high); },
        [&] { return find(v, u, value, low, middle); });
  }
  auto piece(auto& v, Input u, auto& value, int at) const -> decltype(v.number(0.0)) {
    if (method != Method::linear) return value(at);
    if (clips && (at == 0 || at > last())) return value(at == 0 ? 0 : last());
    const int k = clips ? at - 1 : at;
    // Breakpoints that a sweep has put out of order divide by 0, which stops the run by name.
    const auto gap = max(v[x(k + 1)] - v[x(k)], v.number(0.0));
    return value(k) + (v[u] - v[x(k)]) / gap * (value(k + 1) - value(k));
  }
};

}  // namespace flyball
