#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace flyball {

/// A scalar that has no value, only the set of slots that its value depends on. Running an equation once on
/// it tells what each of its results reads. It cannot be compared, so a bare `if` on a signal does not
/// compile.
class Dependency {
 public:
  Dependency() = default;
  Dependency(double) {}

  static Dependency on(int slot);

  /// The slots, ascending.
  std::vector<int> slots() const;

  Dependency& operator|=(const Dependency& other);

  // Arithmetic joins, whatever the operation: dependence is judged from the form, not from the numbers.
  friend Dependency operator+(Dependency a, const Dependency& b) { return a |= b; }
  friend Dependency operator-(Dependency a, const Dependency& b) { return a |= b; }
  friend Dependency operator*(Dependency a, const Dependency& b) { return a |= b; }
  friend Dependency operator/(Dependency a, const Dependency& b) { return a |= b; }
  friend Dependency operator-(Dependency a) { return a; }
  friend Dependency operator+(Dependency a) { return a; }
  Dependency& operator+=(const Dependency& b) { return *this |= b; }
  Dependency& operator-=(const Dependency& b) { return *this |= b; }
  Dependency& operator*=(const Dependency& b) { return *this |= b; }
  Dependency& operator/=(const Dependency& b) { return *this |= b; }

 private:
  std::vector<std::uint64_t> words_;
};

/// What the truth of a relation depends on.
struct DependencyBit {
  Dependency on;

  friend DependencyBit operator&&(DependencyBit a, const DependencyBit& b) { return {a.on |= b.on}; }
  friend DependencyBit operator||(DependencyBit a, const DependencyBit& b) { return {a.on |= b.on}; }
  friend DependencyBit operator!(DependencyBit a) { return a; }
};

inline DependencyBit both(DependencyBit a, const DependencyBit& b) { return a && b; }
inline DependencyBit either(DependencyBit a, const DependencyBit& b) { return a || b; }
inline DependencyBit opposite(DependencyBit a) { return a; }

inline Dependency select(const DependencyBit& bit, Dependency a, const Dependency& b) {
  return a |= bit.on, a |= b;
}

inline Dependency sin(Dependency x) { return x; }
inline Dependency cos(Dependency x) { return x; }
inline Dependency tan(Dependency x) { return x; }
inline Dependency asin(Dependency x) { return x; }
inline Dependency acos(Dependency x) { return x; }
inline Dependency atan(Dependency x) { return x; }
inline Dependency sinh(Dependency x) { return x; }
inline Dependency cosh(Dependency x) { return x; }
inline Dependency tanh(Dependency x) { return x; }
inline Dependency exp(Dependency x) { return x; }
inline Dependency log(Dependency x) { return x; }
inline Dependency log10(Dependency x) { return x; }
inline Dependency sqrt(Dependency x) { return x; }
inline Dependency abs(Dependency x) { return x; }
inline Dependency wrap(Dependency x) { return x; }
inline Dependency pow(Dependency a, const Dependency& b) { return a |= b; }
inline Dependency atan2(Dependency a, const Dependency& b) { return a |= b; }
inline Dependency hypot(Dependency a, const Dependency& b) { return a |= b; }
inline Dependency min(Dependency a, const Dependency& b) { return a |= b; }
inline Dependency max(Dependency a, const Dependency& b) { return a |= b; }

}  // namespace flyball
