#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace flyball {

/// A scalar that has no value, only the set of slots that its value depends on, and whether it is an affine
/// function of those of them that vary during a step. Running an equation once on it tells what each of its
/// results reads. It cannot be compared, so a bare `if` on a signal does not compile.
class Dependency {
 public:
  Dependency() = default;
  Dependency(double) {}

  /// A slot that varies during a step (an input, a state, time), or one that does not (a parameter, a held
  /// value).
  static Dependency on(int slot, bool varies = true);

  /// The slots, ascending.
  std::vector<int> slots() const;
  bool affine() const { return affine_; }

  /// What depends on this in a way that is not affine, unless it does not vary.
  friend Dependency curved(Dependency x) {
    x.affine_ = !x.varies_;
    return x;
  }
  /// Adds the slots only: of a branch that is frozen during a step.
  void read(const Dependency& other);

  // Dependence is judged from the form, not from the numbers.
  Dependency& operator+=(const Dependency& b) { return join(b, affine_ && b.affine_); }
  Dependency& operator-=(const Dependency& b) { return *this += b; }
  Dependency& operator*=(const Dependency& b) {
    return join(b, affine_ && b.affine_ && !(varies_ && b.varies_));
  }
  Dependency& operator/=(const Dependency& b) { return join(b, affine_ && !b.varies_); }
  friend Dependency operator+(Dependency a, const Dependency& b) { return a += b; }
  friend Dependency operator-(Dependency a, const Dependency& b) { return a -= b; }
  friend Dependency operator*(Dependency a, const Dependency& b) { return a *= b; }
  friend Dependency operator/(Dependency a, const Dependency& b) { return a /= b; }
  friend Dependency operator-(Dependency a) { return a; }
  friend Dependency operator+(Dependency a) { return a; }

 private:
  Dependency& join(const Dependency& other, bool affine);

  std::vector<std::uint64_t> words_;
  bool varies_ = false;
  bool affine_ = true;
};

/// What the truth of a relation depends on.
struct DependencyBit {
  Dependency on;

  friend DependencyBit operator&&(DependencyBit a, const DependencyBit& b) { return {a.on += b.on}; }
  friend DependencyBit operator||(DependencyBit a, const DependencyBit& b) { return {a.on += b.on}; }
  friend DependencyBit operator!(DependencyBit a) { return a; }
};

inline DependencyBit both(DependencyBit a, const DependencyBit& b) { return a && b; }
inline DependencyBit either(DependencyBit a, const DependencyBit& b) { return a || b; }
inline DependencyBit opposite(DependencyBit a) { return a; }

inline Dependency select(const DependencyBit& bit, Dependency a, const Dependency& b) {
  a += b;
  a.read(bit.on);
  return a;
}

inline Dependency sin(Dependency x) { return curved(std::move(x)); }
inline Dependency cos(Dependency x) { return curved(std::move(x)); }
inline Dependency tan(Dependency x) { return curved(std::move(x)); }
inline Dependency asin(Dependency x) { return curved(std::move(x)); }
inline Dependency acos(Dependency x) { return curved(std::move(x)); }
inline Dependency atan(Dependency x) { return curved(std::move(x)); }
inline Dependency sinh(Dependency x) { return curved(std::move(x)); }
inline Dependency cosh(Dependency x) { return curved(std::move(x)); }
inline Dependency tanh(Dependency x) { return curved(std::move(x)); }
inline Dependency exp(Dependency x) { return curved(std::move(x)); }
inline Dependency log(Dependency x) { return curved(std::move(x)); }
inline Dependency log10(Dependency x) { return curved(std::move(x)); }
inline Dependency sqrt(Dependency x) { return curved(std::move(x)); }
inline Dependency abs(Dependency x) { return curved(std::move(x)); }
inline Dependency floor(Dependency x) { return curved(std::move(x)); }
inline Dependency wrap(Dependency x) { return curved(std::move(x)); }
inline Dependency pow(Dependency a, const Dependency& b) { return curved(a += b); }
inline Dependency atan2(Dependency a, const Dependency& b) { return curved(a += b); }
inline Dependency hypot(Dependency a, const Dependency& b) { return curved(a += b); }
inline Dependency min(Dependency a, const Dependency& b) { return curved(a += b); }
inline Dependency max(Dependency a, const Dependency& b) { return curved(a += b); }

}  // namespace flyball
