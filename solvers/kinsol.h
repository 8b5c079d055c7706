#pragma once

#include <functional>
#include <memory>

namespace flyball {

/// A system of n equations F(z) = 0.
struct Equations {
  /// False where F is not finite.
  std::function<bool(const double* z, double* f)> residual;
  /// dF/dz by columns. False where it is not finite.
  std::function<bool(const double* z, double* columns)> jacobian;
};

/// Newton's method with a line search, by KINSOL: slower than plain Newton steps, but it also comes home from
/// afar. A copy is a new one.
class Kinsol {
 public:
  Kinsol();
  ~Kinsol();
  Kinsol(const Kinsol&);
  Kinsol& operator=(const Kinsol&);

  /// Moves `z` from a guess towards a solution, until |F| is below `tolerance` or no step leads further down.
  /// Returns whether it is. Allocates at the first call and where `n` changes.
  bool solve(int n, const Equations& equations, double tolerance, double* z);

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

}  // namespace flyball
