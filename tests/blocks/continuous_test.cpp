#include "tests/blocks/linear.h"
#include "tests/catch.h"

namespace flyball::test {
namespace {

using namespace std::string_literals;
using Complex = std::complex<double>;

// Solving with 2 or 3 states of order 1 loses a few bits of 53 to the condition of sI - A, which is below 100
// at these s: 100 * 2^-52 = 2e-14.
constexpr double rounding = 2e-14;

const std::vector<Complex> points{{0.0, 1.0}, {0.5, -2.0}, {3.0, 0.0}, {-0.2, 4.0}};

void check_response(Device& d, const std::vector<std::string>& states, const std::string& input,
                    const std::string& output, auto&& expected) {
  for (const Complex s : points) {
    const Complex h = expected(s);
    INFO("s = " << s);
    CHECK(std::abs(response(d, states, input, output, s) - h) <= rounding * (1.0 + std::abs(h)));
  }
}

bool reads(const BlockObject& object, std::string_view output, std::string_view input) {
  const int y = object.specification->port(output)->slots[0], u = object.specification->port(input)->slots[0];
  return std::ranges::count(object.reads[y], u) > 0;
}

}  // namespace

TEST_CASE("Integrator starts at its initial value and has its input as rate") {
  Device d("Integrator", {{"initial", 2.0}});
  d["u"] = -3.0;
  d.update();
  CHECK(d["y"] == 2.0);
  CHECK(d.rate("x") == -3.0);
}

TEST_CASE("Integrator rests at a limit while its input points outwards, and leaves when it does not") {
  Device d("Integrator", {{"lower", -1.0}, {"upper", 1.0}});
  d["u"] = 3.0;
  d["x"] = 1.0 + 1e-15;  // as located: on the far side
  d.update();
  CHECK(d["meets_upper"] > 0.0);
  CHECK(d.rate("x") == 0.0);
  d.handle(Phase::crossing, "meets_upper");
  CHECK(d["y"] == 1.0);
  d.update();
  CHECK(d.rate("x") == 0.0);
  d["u"] = -2.0;
  d.update();
  CHECK(d.rate("x") == -2.0);
  d["x"] = -1.0 - 1e-15;
  d.update();
  CHECK(d.rate("x") == 0.0);
  d.handle(Phase::crossing, "meets_lower");
  CHECK(d["y"] == -1.0);
  d["u"] = 0.5;
  d.update();
  CHECK(d.rate("x") == 0.5);
}

TEST_CASE("Integrator that starts beyond a limit meets it at once") {
  Device d("Integrator", {{"initial", 5.0}, {"upper", 1.0}});
  d["u"] = 1.0;
  d.update();
  CHECK(d["meets_upper"] == 4.0);
  d.handle(Phase::crossing, "meets_upper");
  CHECK(d["y"] == 1.0);
  d.update();
  CHECK(d.rate("x") == 0.0);
}

TEST_CASE("Integrator resets to its initial value when the reset input passes the threshold") {
  for (const auto& [reset, direction] : {std::pair{"rising", Direction::rising},
                                         {"falling", Direction::falling},
                                         {"either", Direction::either}}) {
    Device d("Integrator", {{"initial", 2.0}, {"reset", std::string(reset)}, {"lower", -1.0}});
    const auto& slots = d.bench().spec().slots;
    const auto change = std::ranges::find(slots, "change", &SlotSpec::name);
    CHECK(change->direction == direction);
    d["x"] = 7.0, d["reset"] = 1.0;
    d.update();
    CHECK(d["change"] == 0.5);
    d.handle(Phase::crossing, "change");
    CHECK(d["y"] == 2.0);
  }
}

TEST_CASE("Derivative responds as N s/(s + N)") {
  Device d("Derivative", {{"N", 20.0}});
  check_response(d, {"filtered"}, "u", "y", [](Complex s) { return 20.0 * s / (s + 20.0); });
}

TEST_CASE("TransferFcn responds as its fraction") {
  Device d("TransferFcn", {{"numerator", Numbers{1.0}}, {"denominator", Numbers{1.0, 2.0, 5.0}}});
  check_response(d, {"x1", "x2"}, "u", "y", [](Complex s) { return 1.0 / (s * s + 2.0 * s + 5.0); });
  CHECK_FALSE(reads(d.bench().object(), "y", "u"));
}

TEST_CASE("TransferFcn is in controllable canonical form") {
  Device d("TransferFcn", {{"numerator", Numbers{3.0, 4.0}}, {"denominator", Numbers{1.0, 2.0, 5.0}}});
  d["u"] = 10.0, d["x1"] = 2.0, d["x2"] = 1.0;
  d.update();
  CHECK(d.rate("x1") == 10.0 - 2.0 * 2.0 - 5.0 * 1.0);
  CHECK(d.rate("x2") == 2.0);
  CHECK(d["y"] == 3.0 * 2.0 + 4.0 * 1.0);
}

TEST_CASE("TransferFcn with equal orders feeds through, scaled by its leading coefficient") {
  Device d("TransferFcn",
           {{"numerator", Numbers{2.0, 0.0, 1.0, 1.0}}, {"denominator", Numbers{4.0, 3.0, 0.0, 5.0}}});
  check_response(d, {"x1", "x2", "x3"}, "u", "y", [](Complex s) {
    return (2.0 * s * s * s + s + 1.0) / (4.0 * s * s * s + 3.0 * s * s + 5.0);
  });
  CHECK(reads(d.bench().object(), "y", "u"));
}

TEST_CASE("TransferFcn takes leading zeros of the numerator for absent") {
  Device d("TransferFcn", {{"numerator", Numbers{0.0, 0.0, 6.0}}, {"denominator", Numbers{2.0, 1.0}}});
  check_response(d, {"x1"}, "u", "y", [](Complex s) { return 6.0 / (2.0 * s + 1.0); });
  CHECK_FALSE(reads(d.bench().object(), "y", "u"));
}

TEST_CASE("StateSpace responds as C (sI - A)^-1 B + D") {
  Device d("StateSpace", {{"A", Table{{0.0, 1.0}, {-2.0, -3.0}}},
                          {"B", Table{{0.0}, {1.0}}},
                          {"C", Table{{4.0, 1.0}}},
                          {"D", Table{{2.0}}}});
  check_response(d, {"x1", "x2"}, "u", "y",
                 [](Complex s) { return (s + 4.0) / (s * s + 3.0 * s + 2.0) + 2.0; });
}

TEST_CASE("StateSpace starts at its initial state, and has vector ports where it is wider than 1") {
  Device d("StateSpace", {{"A", Table{{0.0, 1.0}, {-2.0, -3.0}}},
                          {"B", Table{{1.0, 0.0, 2.0}, {0.0, 1.0, 0.0}}},
                          {"C", Table{{1.0, 0.0}, {0.0, 1.0}}},
                          {"D", Table{{0.0, 0.0, 0.0}, {0.0, 0.0, 7.0}}},
                          {"initial", Numbers{0.0, 5.0}}});
  CHECK(d["x1"] == 0.0);
  CHECK(d["x2"] == 5.0);
  d["u.1"] = 1.0, d["u.3"] = 10.0;
  d.update();
  CHECK(d.rate("x1") == 5.0 + 1.0 + 20.0);
  CHECK(d.rate("x2") == -15.0);
  CHECK(d["y.1"] == 0.0);
  CHECK(d["y.2"] == 75.0);
  const BlockObject& object = d.bench().object();
  const int y2 = object.specification->port("y")->slots[1], u1 = object.specification->port("u")->slots[0];
  CHECK(std::ranges::count(object.reads[y2], u1) == 0);
}

TEST_CASE("ZeroPole responds as its zeros, poles and gain, in any mixture of pairs") {
  using Complex = std::complex<double>;
  struct Roots {
    Numbers real;
    Table complex;
  };
  const auto product = [](const Roots& roots, Complex s) {
    Complex result = 1.0;
    for (const double r : roots.real) result *= s - r;
    for (const Numbers& pair : roots.complex) {
      result *= (s - Complex(pair[0], pair[1])) * (s - Complex(pair[0], -pair[1]));
    }
    return result;
  };
  const std::vector<std::pair<Roots, Roots>> cases{
      {{{}, {}}, {{-2.0}, {}}},
      {{{-3.0}, {}}, {{-2.0}, {}}},
      {{{-3.0}, {}}, {{-2.0, 0.0}, {}}},
      {{{0.0, -3.0}, {}}, {{}, {{-1.0, 2.0}}}},
      {{{}, {{0.0, 4.0}}}, {{-1.0, -2.0, -5.0}, {}}},
      {{{-1.0, 5.0, -6.0}, {}}, {{-4.0}, {{-1.0, 2.0}}}},
      {{{-3.0}, {{-2.0, 1.0}}}, {{-1.0, -2.0, -3.0}, {{-1.0, 1.0}, {0.0, 3.0}}}},
  };
  for (const auto& [zeros, poles] : cases) {
    Keys keys{{"gain", 2.5}};
    if (!zeros.real.empty()) keys["zeros"] = zeros.real;
    if (!zeros.complex.empty()) keys["complex_zeros"] = zeros.complex;
    if (!poles.real.empty()) keys["poles"] = poles.real;
    if (!poles.complex.empty()) keys["complex_poles"] = poles.complex;
    Device d("ZeroPole", keys);
    std::vector<std::string> states;
    const std::size_t order = poles.real.size() + 2 * poles.complex.size();
    for (std::size_t k = 1; k <= order; ++k) states.push_back("x" + std::to_string(k));
    for (const Complex s : {Complex(0.5, 1.0), Complex(2.0, -5.0)}) {
      const Complex expected = 2.5 * product(zeros, s) / product(poles, s);
      INFO("order " << order << ", s = " << s);
      // The resolvent of at most seven states loses two digits.
      CHECK(std::abs(response(d, states, "u", "y", s) - expected) <=
            100 * 0x1p-50 * (1.0 + std::abs(expected)));
    }
  }
}

}  // namespace flyball::test
