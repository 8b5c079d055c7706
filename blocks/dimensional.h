#pragma once

#include <utility>
#include <vector>

#include "blocks/dimension.h"
#include "blocks/linear_form.h"

namespace flyball {

/// An equation between exponents of units: the form is zero. Its unknowns 0 to 6 are the base units
/// themselves, so that one form says the same about all seven exponents.
struct DimensionEquation {
  enum class Kind {
    equal,   // two values are added, compared or selected, or one is the other
    number,  // an argument must be a plain number
    rate     // a rate is its state over seconds
  };

  Kind kind = Kind::equal;
  LinearForm form;

  bool operator==(const DimensionEquation&) const = default;
};

/// Where the equations of one run are collected.
class DimensionRecorder {
 public:
  /// Only what is not said yet is kept, up to a factor.
  void demand(DimensionEquation::Kind kind, LinearForm form);
  std::vector<DimensionEquation> take() { return std::move(equations_); }

 private:
  std::vector<DimensionEquation> equations_;
};

/// A scalar that has no value, only a dimension: a linear form in unknown exponents. Running an equation once
/// on it tells which dimensions must agree. A literal that is added, compared or selected takes the other's
/// dimension, as a factor it is a number, and 0 is free. Like Dependency it cannot be compared.
class Dimensional {
 public:
  Dimensional() = default;
  /// A number in the equation of a block.
  Dimensional(double value);
  /// What has an unknown dimension; demands on it go to `recorder`.
  Dimensional(int unknown, DimensionRecorder& recorder)
      : kind_(Kind::form), form_(unknown), recorder_(&recorder) {}
  /// A literal of a text. As a factor it is an unknown of its own, since it may hide a unit; one that was
  /// written with a unit is that unknown everywhere.
  static Dimensional literal(double value, int unknown, bool has_unit);

  /// Nothing for what fits any dimension.
  const LinearForm* form() const { return kind_ == Kind::form ? &form_ : nullptr; }

  Dimensional& operator+=(const Dimensional& b) { return *this = same(*this, b); }
  Dimensional& operator-=(const Dimensional& b) { return *this = same(*this, b); }
  Dimensional& operator*=(const Dimensional& b) { return *this = product(*this, b, Rational(1)); }
  Dimensional& operator/=(const Dimensional& b) { return *this = product(*this, b, Rational(-1)); }
  friend Dimensional operator+(Dimensional a, const Dimensional& b) { return a += b; }
  friend Dimensional operator-(Dimensional a, const Dimensional& b) { return a -= b; }
  friend Dimensional operator*(Dimensional a, const Dimensional& b) { return a *= b; }
  friend Dimensional operator/(Dimensional a, const Dimensional& b) { return a /= b; }
  friend Dimensional operator-(Dimensional a) { return a; }
  friend Dimensional operator+(Dimensional a) { return a; }

  /// Demands equal dimensions.
  static Dimensional same(const Dimensional& a, const Dimensional& b);
  /// Demands plain numbers, and is one.
  static Dimensional number(const Dimensional& x);
  static Dimensional number(const Dimensional& a, const Dimensional& b);
  static Dimensional power(Dimensional base, double exponent);
  static Dimensional power(const Dimensional& base, const Dimensional& exponent);

 private:
  enum class Kind { free, literal, form };

  static Dimensional product(const Dimensional& a, const Dimensional& b, const Rational& exponent);
  static DimensionRecorder* recorder(const Dimensional& a, const Dimensional& b) {
    return a.recorder_ != nullptr ? a.recorder_ : b.recorder_;
  }

  Kind kind_ = Kind::free;
  LinearForm form_;  // of a literal: what it is as a factor
  double value_ = 0.0;
  DimensionRecorder* recorder_ = nullptr;  // none where only literals took part
};

inline Dimensional select(bool, const Dimensional& a, const Dimensional& b) {
  return Dimensional::same(a, b);
}

inline Dimensional abs(Dimensional x) { return x; }
inline Dimensional min(const Dimensional& a, const Dimensional& b) { return Dimensional::same(a, b); }
inline Dimensional max(const Dimensional& a, const Dimensional& b) { return Dimensional::same(a, b); }
inline Dimensional hypot(const Dimensional& a, const Dimensional& b) { return Dimensional::same(a, b); }
inline Dimensional sqrt(Dimensional x) { return Dimensional::power(std::move(x), 0.5); }
inline Dimensional pow(Dimensional a, double b) { return Dimensional::power(std::move(a), b); }
inline Dimensional pow(const Dimensional& a, const Dimensional& b) { return Dimensional::power(a, b); }
inline Dimensional atan2(const Dimensional& a, const Dimensional& b) {
  return Dimensional::same(a, b) / Dimensional::same(a, b);
}
inline Dimensional sin(const Dimensional& x) { return Dimensional::number(x); }
inline Dimensional cos(const Dimensional& x) { return Dimensional::number(x); }
inline Dimensional tan(const Dimensional& x) { return Dimensional::number(x); }
inline Dimensional asin(const Dimensional& x) { return Dimensional::number(x); }
inline Dimensional acos(const Dimensional& x) { return Dimensional::number(x); }
inline Dimensional atan(const Dimensional& x) { return Dimensional::number(x); }
inline Dimensional sinh(const Dimensional& x) { return Dimensional::number(x); }
inline Dimensional cosh(const Dimensional& x) { return Dimensional::number(x); }
inline Dimensional tanh(const Dimensional& x) { return Dimensional::number(x); }
inline Dimensional exp(const Dimensional& x) { return Dimensional::number(x); }
inline Dimensional log(const Dimensional& x) { return Dimensional::number(x); }
inline Dimensional log10(const Dimensional& x) { return Dimensional::number(x); }
inline Dimensional floor(const Dimensional& x) { return Dimensional::number(x); }
inline Dimensional wrap(const Dimensional& x) { return Dimensional::number(x); }

}  // namespace flyball
