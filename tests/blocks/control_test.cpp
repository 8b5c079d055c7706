#include "tests/blocks/linear.h"
#include "tests/catch.h"

namespace flyball::test {
namespace {

using namespace std::string_literals;
using Complex = std::complex<double>;

Rational ratio(std::int64_t numerator, std::int64_t denominator) {
  return Rational::fraction(numerator, denominator).value();
}

// A few roundings in a sum of terms whose sizes are at most 100 times the result.
constexpr double rounding = 100 * 0x1p-52;

}  // namespace

TEST_CASE("PID responds as Kp + Ki/s + Kd N s/(s + N)") {
  Device d("PID", {{"Kp", 2.0}, {"Ki", 3.0}, {"Kd", 0.5}, {"N", 20.0}});
  for (const Complex s : {Complex(0.0, 1.0), Complex(2.0, -5.0), Complex(0.1, 30.0)}) {
    const Complex h = 2.0 + 3.0 / s + 0.5 * 20.0 * s / (s + 20.0);
    INFO("s = " << s);
    CHECK(std::abs(response(d, {"integral", "filtered"}, "e", "u", s) - h) <= rounding * std::abs(h));
  }
}

TEST_CASE("PID weighs the setpoint in P by b and in D by c, and not in I") {
  Device d("PID", {{"Kp", 2.0},
                   {"Ki", 3.0},
                   {"Kd", 0.5},
                   {"N", 20.0},
                   {"b", 0.4},
                   {"c", 0.25},
                   {"setpoint_weights", true}});
  const Complex s(0.3, 2.0), derivative = 0.5 * 20.0 * s / (s + 20.0);
  const Complex from_setpoint = 2.0 * 0.4 + 3.0 / s + 0.25 * derivative;
  const Complex from_measurement = -(2.0 + 3.0 / s + derivative);
  CHECK(std::abs(response(d, {"integral", "filtered"}, "setpoint", "u", s) - from_setpoint) <= 10 * rounding);
  CHECK(std::abs(response(d, {"integral", "filtered"}, "measurement", "u", s) - from_measurement) <=
        10 * rounding);
}

TEST_CASE("PID in ideal form responds as Kp (1 + Ki/s + Kd N s/(s + N))") {
  Device d("PID", {{"Kp", 2.0}, {"Ki", 3.0}, {"Kd", 0.5}, {"N", 20.0}, {"form", "ideal"s}});
  const Complex s(0.3, 2.0), h = 2.0 * (1.0 + 3.0 / s + 0.5 * 20.0 * s / (s + 20.0));
  CHECK(std::abs(response(d, {"integral", "filtered"}, "e", "u", s) - h) <= rounding * std::abs(h));
}

TEST_CASE("PID in series form responds as Kp (1 + Ki/s)(1 + Kd N s/(s + N))") {
  Device d("PID", {{"Kp", 2.0}, {"Ki", 3.0}, {"Kd", 0.5}, {"N", 20.0}, {"form", "series"s}});
  for (const Complex s : {Complex(0.0, 1.0), Complex(2.0, -5.0), Complex(0.1, 30.0)}) {
    const Complex h = 2.0 * (1.0 + 3.0 / s) * (1.0 + 0.5 * 20.0 * s / (s + 20.0));
    INFO("s = " << s);
    CHECK(std::abs(response(d, {"integral", "filtered"}, "e", "u", s) - h) <= rounding * std::abs(h));
  }
}

TEST_CASE("PID adds its feed-forward before the limits") {
  Device d("PID", {{"Kp", 2.0}, {"feed_forward", true}, {"upper", 5.0}});
  d["e"] = 1.0, d["u_ff"] = 2.5;
  CHECK(d.update()["u"] == 4.5);
  d["u_ff"] = 4.0;
  CHECK(d.update()["u"] == 5.0);
}

TEST_CASE("PID with tracking lets I follow what the actuator makes of u") {
  Device d("PID", {{"Kp", 2.0}, {"Ki", 3.0}, {"anti_windup", "tracking"s}, {"Tt", 0.5}});
  d["e"] = 1.0, d["integral"] = 1.0, d["u_actual"] = 2.5;
  d.update();
  CHECK(d["u"] == 3.0);
  CHECK(d.rate("integral") == 3.0 + (2.5 - 3.0) / 0.5);
}

TEST_CASE("PID goes from manual to automatic with the integral that makes no jump") {
  Device d(
      "PID",
      {{"Kp", 2.0}, {"Ki", 3.0}, {"Kd", 0.25}, {"N", 4.0}, {"manual_mode", true}, {"feed_forward", true}});
  d["e"] = 1.0, d["filtered"] = 0.5, d["integral"] = 7.0, d["u_ff"] = 1.0, d["u_manual"] = -3.0;
  // At the start in automatic mode nothing is changed.
  d["automatic"] = 1.0;
  d.update();
  d.handle(Phase::crossing, "to_automatic");
  CHECK(d["integral"] == 7.0);
  CHECK(d.update()["u"] == 2.0 + 7.0 + 0.5 + 1.0);
  d["automatic"] = 0.0;
  d.update();
  CHECK(d["u"] == -3.0);
  d.handle(Phase::crossing, "to_manual");
  d.update();
  CHECK(d["u"] == -3.0);
  CHECK(d.rate("integral") == 0.0);
  d["automatic"] = 1.0;
  // Within the instant, too, before I is committed.
  CHECK(d.update()["u"] == -3.0);
  d.handle(Phase::crossing, "to_automatic");
  CHECK(d.update()["u"] == -3.0);
  CHECK(d.rate("integral") == 3.0);
}

TEST_CASE("PID limits its output, and without anti-windup integrates on") {
  Device d("PID", {{"Kp", 2.0}, {"Ki", 3.0}, {"lower", -4.0}, {"upper", 5.0}});
  d["e"] = 10.0;
  d.update();
  CHECK(d["u"] == 5.0);
  CHECK(d.rate("integral") == 30.0);
  d["e"] = -10.0;
  d.update();
  CHECK(d["u"] == -4.0);
  CHECK(d.rate("integral") == -30.0);
  d["e"] = 1.0;
  d.update();
  CHECK(d["u"] == 2.0);
}

TEST_CASE("PID with clamping keeps I within the limits") {
  Device d("PID", {{"Kp", 0.0}, {"Ki", 3.0}, {"lower", -4.0}, {"upper", 5.0}, {"anti_windup", "clamping"s}});
  d["e"] = 1.0;
  d["integral"] = 5.0 + 1e-14;
  d.update();
  CHECK(d.rate("integral") == 0.0);
  d.handle(Phase::crossing, "meets_upper");
  CHECK(d["integral"] == 5.0);
  d["e"] = -1.0;
  d.update();
  CHECK(d.rate("integral") == -3.0);
  // P at its limit does not hold I.
  d["Kp"] = 100.0, d["e"] = 1.0, d["integral"] = 0.0;
  d.update();
  CHECK(d["u"] == 5.0);
  CHECK(d.rate("integral") == 3.0);
}

TEST_CASE("PID with back calculation lets I follow the limited output") {
  Device d("PID", {{"Kp", 2.0},
                   {"Ki", 3.0},
                   {"lower", -4.0},
                   {"upper", 5.0},
                   {"anti_windup", "back_calculation"s},
                   {"Tt", 0.5}});
  d["e"] = 4.0, d["integral"] = 1.0;
  d.update();
  CHECK(d["u"] == 5.0);
  CHECK(d.rate("integral") == 3.0 * 4.0 + (5.0 - 9.0) / 0.5);
  d["e"] = 1.0;
  d.update();
  CHECK(d["u"] == 3.0);
  CHECK(d.rate("integral") == 3.0);
}

TEST_CASE("DiscretePID with its default rules is I += Ki Ts e before use, D = Kd (e - e_last)/Ts") {
  const double Kp = 0.5, Ki = 10.0, Kd = 1e-4, Ts = 1e-3;
  Device d("DiscretePID", {{"Kp", Kp},
                           {"Ki", Ki},
                           {"Kd", Kd},
                           {"sample_time", ratio(1, 1000)},
                           {"lower", -24.0},
                           {"upper", 24.0}});
  double I = 0.0, last = 0.0;
  for (int k = 0; k < 2000; ++k) {
    const double e = 30.0 * std::cos(0.01 * k);
    I += Ki * Ts * e;
    const double sum = Kp * e + I + Kd * (e - last) / Ts;
    last = e;
    d["e"] = e;
    // Both sums round once a term; over 2000 hits I, below 40, gathers at most 2000 half units in its last
    // place.
    REQUIRE(std::fabs(d.hit("u") - std::clamp(sum, -24.0, 24.0)) <= 2000 * 0x1p-52 * 40.0);
  }
}

TEST_CASE("DiscretePID integrates by the rule that it names") {
  const std::vector<double> errors{1.0, 3.0, -2.0, 4.0};
  // Ts = 1/2, Ki = 1: half of the sum up to e before, up to e, or of the mean of both.
  const std::map<std::string, std::vector<double>> integrals{{"forward", {0.0, 0.5, 2.0, 1.0}},
                                                             {"backward", {0.5, 2.0, 1.0, 3.0}},
                                                             {"trapezoidal", {0.25, 1.25, 1.5, 2.0}}};
  for (const auto& [rule, expected] : integrals) {
    Device d("DiscretePID", {{"Kp", 0.0}, {"Ki", 1.0}, {"integral", rule}, {"sample_time", ratio(1, 2)}});
    for (std::size_t k = 0; k < errors.size(); ++k) {
      d["e"] = errors[k];
      INFO(rule << ", hit " << k);
      CHECK(d.hit("u") == expected[k]);
    }
  }
}

TEST_CASE("DiscretePID filters its derivative by a backward difference") {
  const double Kd = 2.0, N = 4.0, Ts = 0.25;
  Device d("DiscretePID",
           {{"Kp", 0.0}, {"Kd", Kd}, {"N", N}, {"derivative", "filtered"s}, {"sample_time", ratio(1, 4)}});
  d["e"] = 1.0;
  // Of a step at hit 0, with D' = N (Kd e' - D): D_k = Kd N / (1 + N Ts)^(k+1), exact in powers of 2.
  for (int k = 0; k < 5; ++k) CHECK(d.hit("u") == Kd * N / std::pow(1.0 + N * Ts, k + 1));
}

TEST_CASE("DiscretePID weighs the setpoint in P by b and in D by c, and not in I") {
  Device d("DiscretePID", {{"Kp", 2.0},
                           {"Ki", 1.0},
                           {"Kd", 0.5},
                           {"b", 0.5},
                           {"c", 0.25},
                           {"setpoint_weights", true},
                           {"sample_time", ratio(1, 2)}});
  d["setpoint"] = 8.0, d["measurement"] = 1.0;
  // P = 2 (4 - 1), I = 0.5 * 7, D = 0.5 (2 - 1)/0.5
  CHECK(d.hit("u") == 6.0 + 3.5 + 1.0);
  CHECK(d.hit("u") == 6.0 + 7.0 + 0.0);
}

TEST_CASE("DiscretePID with clamping keeps I within the limits") {
  Device d("DiscretePID", {{"Kp", 0.0},
                           {"Ki", 1.0},
                           {"lower", -1.0},
                           {"upper", 2.0},
                           {"anti_windup", "clamping"s},
                           {"sample_time", Rational(1)}});
  d["e"] = 1.5;
  CHECK(d.hit("u") == 1.5);
  CHECK(d.hit("u") == 2.0);
  CHECK(d.hit("u") == 2.0);
  d["e"] = -0.5;
  CHECK(d.hit("u") == 1.5);
}

TEST_CASE("DiscretePID with back calculation lets I follow the limited output") {
  Device d("DiscretePID", {{"Kp", 1.0},
                           {"Ki", 1.0},
                           {"lower", -1.0},
                           {"upper", 2.0},
                           {"anti_windup", "back_calculation"s},
                           {"Tt", 2.0},
                           {"sample_time", Rational(1)}});
  d["e"] = 3.0;
  CHECK(d.hit("u") == 2.0);
  // I = 3 + (1/2)(2 - 6)
  CHECK(d["integral"] == 1.0);
}

TEST_CASE("DiscretePID in ideal and series form is the product that they are named for") {
  // With the backward rule I and D are Ts z/(z - 1) and (z - 1)/(Ts z), so the product is that of two blocks
  // in a row.
  const double Kp = 2.0, Ki = 0.5, Kd = 0.25, Ts = 0.5;
  Device ideal("DiscretePID",
               {{"Kp", Kp}, {"Ki", Ki}, {"Kd", Kd}, {"form", "ideal"s}, {"sample_time", ratio(1, 2)}});
  Device series("DiscretePID",
                {{"Kp", Kp}, {"Ki", Ki}, {"Kd", Kd}, {"form", "series"s}, {"sample_time", ratio(1, 2)}});
  double sum = 0.0, sum_of_lead = 0.0, last = 0.0;
  for (const double e : {1.0, 3.0, -2.0, 4.0}) {
    ideal["e"] = series["e"] = e;
    const double difference = (e - last) / Ts, lead = e + Kd * difference;
    sum += Ts * e, sum_of_lead += Ts * lead, last = e;
    // Dyadic numbers of few digits: all sums are exact.
    CHECK(ideal.hit("u") == Kp * (e + Ki * sum + Kd * difference));
    CHECK(series.hit("u") == Kp * (lead + Ki * sum_of_lead));
  }
}

TEST_CASE("DiscretePID goes on from the manual value") {
  Device d("DiscretePID", {{"Kp", 2.0},
                           {"Ki", 1.0},
                           {"manual_mode", true},
                           {"feed_forward", true},
                           {"sample_time", ratio(1, 2)}});
  d["e"] = 1.0, d["u_ff"] = 0.25, d["u_manual"] = -3.0;
  CHECK(d.hit("u") == -3.0);
  CHECK(d.hit("u") == -3.0);
  d["automatic"] = 1.0;
  // What has changed since the last hit is one step of integration.
  CHECK(d.hit("u") == -3.0 + 0.5);
  CHECK(d.hit("u") == -3.0 + 1.0);
}

TEST_CASE("DiscretePID with tracking lets I follow what the actuator makes of u") {
  Device d(
      "DiscretePID",
      {{"Kp", 1.0}, {"Ki", 1.0}, {"anti_windup", "tracking"s}, {"Tt", 2.0}, {"sample_time", Rational(1)}});
  d["e"] = 3.0, d["u_actual"] = 2.0;
  CHECK(d.hit("u") == 6.0);
  // I = 3 + (1/2)(2 - 6)
  CHECK(d["integral"] == 1.0);
}

}  // namespace flyball::test
