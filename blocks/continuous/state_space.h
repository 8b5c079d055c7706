#pragma once
#include <algorithm>

#include "blocks/block.h"

namespace flyball {

struct StateSpace : Block {
  static constexpr auto summary = "A linear system: x' = A x + B u, y = C x + D u.";
  static constexpr std::array aliases{"Modelica.Blocks.Continuous.StateSpace", "CLSS", "CLSS_f"};
  Coefficients A = matrix("A", {{-1.0}}, "state matrix");
  Coefficients B = matrix("B", {{1.0}}, "input matrix");
  Coefficients C = matrix("C", {{1.0}}, "output matrix");
  Coefficients D = matrix("D", {{0.0}}, "feedthrough matrix, 0 if not given");
  Coefficients initial = coefficients("initial", {}, "any", "state at the start, 0 if not given");
  Inputs u = B.columns() == 1 ? Inputs(input("u", "any", "input").slot, 1)
                              : input_vector("u", B.columns(), "any", "input");
  Outputs y = C.rows() == 1 ? Outputs(output("y", "any", "output").slot, 1)
                            : output_vector("y", C.rows(), "any", "output");
  States x = declare_states();

  explicit StateSpace(Settings* settings) : Block(settings) {
    const int n = A.rows(), inputs = B.columns(), outputs = C.rows();
    if (n == 0) refuse("A", "expected at least one row");
    expect("A", A, n, n);
    expect("B", B, n, std::max(inputs, 1));
    expect("C", C, std::max(outputs, 1), n);
    if (given("D")) expect("D", D, outputs, inputs);
    if (given("initial")) expect("initial", initial, 1, n);
  }

  void rates(auto& v) const {
    for (int i = 0; i < x.size(); ++i) v.rate(x[i]) = product(v, A, i, x) + product(v, B, i, u);
  }
  void outputs(auto& v) const {
    for (int i = 0; i < y.size(); ++i) v[y[i]] = product(v, C, i, x) + product(v, D, i, u);
  }

 private:
  /// Row i of matrix times vector.
  static auto product(auto& v, const Coefficients& matrix, int i, const auto& vector) {
    auto sum = v.number(0.0);
    for (const auto& m : matrix.row(i)) sum += v[m.param] * v[vector[m.column]];
    return sum;
  }
  States declare_states() {
    std::vector<Param> start(A.rows());
    for (const auto& entry : initial.row(0)) {
      if (entry.column < A.rows()) start[entry.column] = entry.param;
    }
    if (start.empty()) return states("x", 0, "any", "state");
    const int first = declare_state(1, start[0]).slot;
    for (int k = 1; k < A.rows(); ++k) declare_state(k + 1, start[k]);
    return {first, A.rows()};
  }
  State declare_state(int number, Param start) {
    const std::string name = "x" + std::to_string(number);
    return start.declared() ? state(name, start, "any", "state") : state(name, 0.0, "any", "state");
  }
  void expect(const std::string& key, const Coefficients& found, int rows, int columns) {
    if (found.rows() == rows && found.columns() == columns) return;
    const auto size = [](int r, int c) { return std::to_string(r) + " by " + std::to_string(c); };
    refuse(key, "expected " + size(rows, columns) + " numbers, found " + size(found.rows(), found.columns()));
  }
};

}  // namespace flyball
