#pragma once

#include <cmath>
#include <cstdint>

#include "blocks/isa.h"
#include "blocks/scalar.h"

namespace flyball {

/// Vectors of one register. They may alias plain numbers, so that a lane can be read as one.
template <Isa isa>
struct Register;
template <>
struct Register<Isa::baseline> {
  using Numbers [[gnu::vector_size(16), gnu::may_alias]] = double;
  using Masks [[gnu::vector_size(16), gnu::may_alias]] = std::int64_t;
};
template <>
struct Register<Isa::avx2> {
  using Numbers [[gnu::vector_size(32), gnu::may_alias]] = double;
  using Masks [[gnu::vector_size(32), gnu::may_alias]] = std::int64_t;
};

template <Isa isa>
class LaneBit;

/// One number of each run of a group. What is computed in a lane has the bits of the same computation on
/// double. The instruction set is part of the type, so that no function of one unit can stand in for that of
/// another. Lanes cannot be compared, so a bare `if` on a signal does not compile.
template <Isa isa>
class alignas(8 * lane_count) Lanes {
 public:
  using Numbers = typename Register<isa>::Numbers;
  static constexpr int width = sizeof(Numbers) / sizeof(double);
  static constexpr int parts = lane_count / width;

  Lanes() = default;
  Lanes(double x) {
    for (Numbers& p : part_) p = x - Numbers{};  // 0 + x would lose the sign of -0
  }

  double lane(int k) const { return part_[k / width][k % width]; }
  void set_lane(int k, double x) { part_[k / width][k % width] = x; }
  const Numbers& part(int k) const { return part_[k]; }
  Numbers& part(int k) { return part_[k]; }

  Lanes& operator+=(const Lanes& b) {
    return each(b, [](Numbers& x, const Numbers& y) { x += y; });
  }
  Lanes& operator-=(const Lanes& b) {
    return each(b, [](Numbers& x, const Numbers& y) { x -= y; });
  }
  Lanes& operator*=(const Lanes& b) {
    return each(b, [](Numbers& x, const Numbers& y) { x *= y; });
  }
  Lanes& operator/=(const Lanes& b) {
    return each(b, [](Numbers& x, const Numbers& y) { x /= y; });
  }
  friend Lanes operator+(const Lanes& a, const Lanes& b) { return Lanes(a) += b; }
  friend Lanes operator-(const Lanes& a, const Lanes& b) { return Lanes(a) -= b; }
  friend Lanes operator*(const Lanes& a, const Lanes& b) { return Lanes(a) *= b; }
  friend Lanes operator/(const Lanes& a, const Lanes& b) { return Lanes(a) /= b; }
  friend Lanes operator+(const Lanes& a) { return a; }
  friend Lanes operator-(const Lanes& a) {
    Lanes negative;
    for (int k = 0; k < parts; ++k) negative.part_[k] = -a.part_[k];
    return negative;
  }

  friend LaneBit<isa> greater(const Lanes& a, const Lanes& b) {
    LaneBit<isa> bit;
    for (int k = 0; k < parts; ++k) bit.part(k) = a.part_[k] > b.part_[k];
    return bit;
  }
  friend LaneBit<isa> nonzero(const Lanes& x) {
    LaneBit<isa> bit;
    for (int k = 0; k < parts; ++k) bit.part(k) = x.part_[k] != Numbers{};
    return bit;
  }
  /// Where x is not a number.
  friend LaneBit<isa> unordered(const Lanes& x) {
    LaneBit<isa> bit;
    for (int k = 0; k < parts; ++k) bit.part(k) = x.part_[k] != x.part_[k];
    return bit;
  }
  friend Lanes min(const Lanes& a, const Lanes& b) { return select(greater(a, b), b, a); }
  friend Lanes max(const Lanes& a, const Lanes& b) { return select(greater(b, a), b, a); }

  friend Lanes abs(const Lanes& x) {
    using Masks = typename Register<isa>::Masks;
    constexpr std::int64_t all_but_the_sign = 0x7fffffffffffffff;
    Lanes y;
    for (int k = 0; k < parts; ++k) y.part_[k] = Numbers(Masks(x.part_[k]) & (Masks{} + all_but_the_sign));
    return y;
  }

  // Lane by lane through the same functions as double, so that the bits are the same.
  friend Lanes sqrt(const Lanes& x) {
    return map(x, [](double a) { return std::sqrt(a); });
  }
  friend Lanes sin(const Lanes& x) {
    return map(x, [](double a) { return std::sin(a); });
  }
  friend Lanes cos(const Lanes& x) {
    return map(x, [](double a) { return std::cos(a); });
  }
  friend Lanes tan(const Lanes& x) {
    return map(x, [](double a) { return std::tan(a); });
  }
  friend Lanes asin(const Lanes& x) {
    return map(x, [](double a) { return std::asin(a); });
  }
  friend Lanes acos(const Lanes& x) {
    return map(x, [](double a) { return std::acos(a); });
  }
  friend Lanes atan(const Lanes& x) {
    return map(x, [](double a) { return std::atan(a); });
  }
  friend Lanes sinh(const Lanes& x) {
    return map(x, [](double a) { return std::sinh(a); });
  }
  friend Lanes cosh(const Lanes& x) {
    return map(x, [](double a) { return std::cosh(a); });
  }
  friend Lanes tanh(const Lanes& x) {
    return map(x, [](double a) { return std::tanh(a); });
  }
  friend Lanes exp(const Lanes& x) {
    return map(x, [](double a) { return std::exp(a); });
  }
  friend Lanes log(const Lanes& x) {
    return map(x, [](double a) { return std::log(a); });
  }
  friend Lanes log10(const Lanes& x) {
    return map(x, [](double a) { return std::log10(a); });
  }
  /// A function of two numbers, lane by lane.
  friend Lanes each(const Lanes& a, const Lanes& b, double (*function)(double, double)) {
    return map(a, b, function);
  }
  friend Lanes floor(const Lanes& x) {
    return map(x, [](double a) { return std::floor(a); });
  }
  friend Lanes wrap(const Lanes& x) {
    return map(x, [](double a) { return flyball::wrap(a); });
  }
  friend Lanes pow(const Lanes& x, const Lanes& y) {
    return map(x, y, [](double a, double b) { return std::pow(a, b); });
  }
  friend Lanes atan2(const Lanes& x, const Lanes& y) {
    return map(x, y, [](double a, double b) { return std::atan2(a, b); });
  }
  friend Lanes hypot(const Lanes& x, const Lanes& y) {
    return map(x, y, [](double a, double b) { return std::hypot(a, b); });
  }

 private:
  Lanes& each(const Lanes& b, auto&& operation) {
    for (int k = 0; k < parts; ++k) operation(part_[k], b.part_[k]);
    return *this;
  }
  static Lanes map(const Lanes& x, auto&& function) {
    Lanes y;
    for (int k = 0; k < lane_count; ++k) y.set_lane(k, function(x.lane(k)));
    return y;
  }
  static Lanes map(const Lanes& a, const Lanes& b, auto&& function) {
    Lanes y;
    for (int k = 0; k < lane_count; ++k) y.set_lane(k, function(a.lane(k), b.lane(k)));
    return y;
  }

  Numbers part_[parts];
};

/// The truth of a relation in each lane: all ones or all zeros.
template <Isa isa>
class alignas(8 * lane_count) LaneBit {
 public:
  using Masks = typename Register<isa>::Masks;
  static constexpr int width = Lanes<isa>::width, parts = Lanes<isa>::parts;

  LaneBit() = default;
  /// Lane k is on where bit k of `lanes` is.
  explicit LaneBit(unsigned char lanes) {
    for (int k = 0; k < parts; ++k) {
      Masks places;
      for (int j = 0; j < width; ++j) places[j] = std::int64_t{1} << (k * width + j);
      part_[k] = ((Masks{} + lanes) & places) != Masks{};
    }
  }

  /// Bit k is set where lane k is on.
  unsigned char lanes() const {
    unsigned lanes = 0;
    for (int k = 0; k < lane_count; ++k) lanes |= (part_[k / width][k % width] != 0 ? 1u : 0u) << k;
    return static_cast<unsigned char>(lanes);
  }
  const Masks& part(int k) const { return part_[k]; }
  Masks& part(int k) { return part_[k]; }

  friend LaneBit both(const LaneBit& a, const LaneBit& b) {
    LaneBit bit;
    for (int k = 0; k < parts; ++k) bit.part_[k] = a.part_[k] & b.part_[k];
    return bit;
  }
  friend LaneBit either(const LaneBit& a, const LaneBit& b) {
    LaneBit bit;
    for (int k = 0; k < parts; ++k) bit.part_[k] = a.part_[k] | b.part_[k];
    return bit;
  }
  friend LaneBit opposite(const LaneBit& a) {
    LaneBit bit;
    for (int k = 0; k < parts; ++k) bit.part_[k] = ~a.part_[k];
    return bit;
  }
  friend Lanes<isa> select(const LaneBit& on, const Lanes<isa>& a, const Lanes<isa>& b) {
    Lanes<isa> result;
    for (int k = 0; k < parts; ++k) result.part(k) = on.part_[k] ? a.part(k) : b.part(k);
    return result;
  }

 private:
  Masks part_[parts];
};

/// Each lane has a count of its own: a block that needs it says that it has no lockstep
/// (blocks/lane_kernels.h).
template <Isa isa>
int index_of(const Lanes<isa>& count) = delete;

template <Isa isa>
struct BitOf<Lanes<isa>> {
  using type = LaneBit<isa>;
};

}  // namespace flyball
