// The functions that equations call, on each scalar.
#include "blocks/jet.h"

#include <concepts>

#include "tests/catch.h"

namespace flyball::test {
namespace {

using Slots = std::vector<int>;

Jet variable(double x) { return Jet(x, 0); }

}  // namespace

TEST_CASE("a dependency joins the slots of what it is computed from") {
  const Dependency a = Dependency::on(3), b = Dependency::on(130);
  CHECK(Dependency(2.0).slots().empty());
  CHECK((a * 2.0 + b / a).slots() == Slots{3, 130});
  CHECK((1.0 - a).slots() == Slots{3});
  CHECK(atan2(sin(b), sqrt(a)).slots() == Slots{3, 130});
  Dependency sum(0.0);
  sum += b;
  sum -= a;
  CHECK(sum.slots() == Slots{3, 130});
}

TEST_CASE("multiplication by the number 0 is judged from its form") {
  CHECK((Dependency(0.0) * Dependency::on(1)).slots() == Slots{1});
}

TEST_CASE("select on dependencies joins the condition and both branches") {
  const DependencyBit bit{Dependency::on(1)}, other{Dependency::on(5)};
  CHECK(select(bit, Dependency::on(2), Dependency::on(64)).slots() == Slots{1, 2, 64});
  CHECK(select(both(bit, opposite(other)), 1.0, 2.0).slots() == Slots{1, 5});
  CHECK(select(either(other, bit), 1.0, 2.0).slots() == Slots{1, 5});
}

TEST_CASE("a dependency cannot be compared") {
  CHECK_FALSE(std::totally_ordered<Dependency>);
  CHECK_FALSE(std::equality_comparable<Dependency>);
  CHECK_FALSE(std::convertible_to<DependencyBit, bool>);
}

TEST_CASE("select takes one branch, with its derivative") {
  CHECK(select(true, 1.0, 2.0) == 1.0);
  CHECK(select(false, 1.0, 2.0) == 2.0);
  CHECK(select(true, variable(3.0), 2.0).v[0] == 1.0);
  CHECK(select(true, 2.0, variable(3.0)).v[0] == 0.0);
}

TEST_CASE("kinks take the side of the value") {
  CHECK(abs(variable(-2.0)).v[0] == -1.0);
  CHECK(min(variable(1.0), Jet(2.0)).v[0] == 1.0);
  CHECK(max(variable(1.0), Jet(2.0)).v[0] == 0.0);
  CHECK(clamp(5.0, -1.0, 1.0) == 1.0);
  CHECK(clamp(-5.0, -1.0, 1.0) == -1.0);
  CHECK(clamp(variable(0.5), Jet(-1.0), Jet(1.0)).v[0] == 1.0);
  // crossed limits: the lower one wins
  CHECK(clamp(0.0, 2.0, 1.0) == 2.0);
}

TEST_CASE("wrap takes whole turns away and keeps the derivative") {
  // one rounding in 2 pi and one in the remainder, at a size of 7
  const double two_ulps = 2 * 0x1p-52 * 7.0;
  CHECK(std::fabs(wrap(7.0) - (7.0 - 2.0 * M_PI)) <= two_ulps);
  CHECK(std::fabs(wrap(-7.0) - (2.0 * M_PI - 7.0)) <= two_ulps);
  CHECK(wrap(0.5) == 0.5);
  CHECK(wrap(variable(7.0)).v[0] == 1.0);
}

}  // namespace flyball::test
