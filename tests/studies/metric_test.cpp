#include "studies/metrics/metric.h"

#include <cmath>
#include <numbers>

#include "studies/file.h"
#include "studies/metrics/measures.h"
#include "tests/catch.h"
#include "tests/studies/hand_made_log.h"
#include "tests/studies/temporary_folder.h"

using namespace flyball;
using test::hand_made_log;

namespace {

constexpr double step = 1e-3;

/// A first-order step of 2 V with the time constant 0.5 s, its input, a sine of 3 A, and a circle of 2 m.
Log sample(double end = 20.0) {
  return hand_made_log({{"y", "V", [](double t) { return 2.0 - 2.0 * std::exp(-t / 0.5); }},
                        {"u", "V", [](double) { return 2.0; }},
                        {"motor.i", "A", [](double t) { return 3.0 * std::sin(2.0 * std::numbers::pi * t); }},
                        {"x1", "m", [](double t) { return 2.0 * std::cos(t); }},
                        {"x2", "m", [](double t) { return 2.0 * std::sin(t); }},
                        {"free", "any", [](double t) { return t; }},
                        {"s", "m", [](double t) { return t; }}},
                       end, step);
}

double value(const std::string& text, double end = 20.0) {
  const Log log = sample(end);
  return Metric(text, log.columns()).evaluate(log);
}

std::string unit(const std::string& text) { return Metric(text, sample(0.0).columns()).unit(); }

/// Offset and message of what is wrong with a text.
std::string refusal(const std::string& text) {
  try {
    const Metric metric(text, sample(0.0).columns());
  } catch (const TextError& error) {
    return std::to_string(error.offset()) + ": " + error.what();
  }
  return "nothing is wrong";
}

}  // namespace

TEST_CASE("Metric: measures of a first-order step have their closed forms") {
  // Grid points are step apart, signals straight between them: step^2/8 of the curvature over the slope.
  const double margin = 1e-6;
  CHECK(value("settling(y)") == Approx(0.5 * std::log(50.0)).margin(margin));
  CHECK(value("settling(y, 5 %)") == Approx(0.5 * std::log(20.0)).margin(margin));
  CHECK(value("settling(y, band = 5 %, final = 2 V)") == Approx(0.5 * std::log(20.0)).margin(margin));
  CHECK(value("rise(y)") == Approx(0.5 * std::log(9.0)).margin(margin));
  CHECK(value("delay(y)") == Approx(0.5 * std::log(2.0)).margin(margin));
  CHECK(value("dead_time(y, 10 %)") == Approx(0.5 * std::log(1 / 0.9)).margin(margin));
  CHECK(value("overshoot(y)") == 0.0);
  CHECK(value("overshoot(y, 0 V, 1.6 V)") == Approx(0.25).epsilon(1e-12));
  CHECK(value("overshoot(y, final = 1.6 V)") == Approx(0.25).epsilon(1e-12));
  // exp(-40) is left of the way.
  CHECK(value("steady_state_error(y, u)") == Approx(0.0).margin(1e-15));
  CHECK(value("peak(y)") == Approx(2.0).epsilon(1e-15));
  CHECK(value("peak_time(motor.i)") == Approx(0.25).margin(1e-12));
}

TEST_CASE("Metric: integrals of an exponential error have their closed forms") {
  // Trapezoids: step^2/12 times the change of the slope, which is at most 16.
  const double margin = 2e-6;
  CHECK(value("IAE(u - y)") == Approx(2.0 * 0.5).margin(margin));
  CHECK(value("ise(u - y)") == Approx(4.0 * 0.25).margin(margin));
  CHECK(value("ITAE(u - y)") == Approx(2.0 * 0.25).margin(margin));
  CHECK(value("ITSE(u - y)") == Approx(4.0 * 0.0625).margin(margin));
  CHECK(value("integral(u)") == Approx(40.0).epsilon(1e-12));
  CHECK(value("effort(u)") == Approx(80.0).epsilon(1e-12));
  CHECK(value("integral(u^2)") == Approx(80.0).epsilon(1e-12));
  CHECK(value("integral(time)") == Approx(200.0).epsilon(1e-12));
}

TEST_CASE("Metric: values over time") {
  CHECK(value("max(motor.i)") == Approx(3.0).epsilon(1e-12));
  CHECK(value("min(motor.i)") == Approx(-3.0).epsilon(1e-12));
  // Trapezoids over whole periods are exact but for rounding.
  CHECK(value("rms(motor.i)") == Approx(3.0 / std::sqrt(2.0)).epsilon(1e-12));
  CHECK(value("mean(motor.i)") == Approx(0.0).margin(1e-12));
  CHECK(value("mean(abs(motor.i))") == Approx(6.0 / std::numbers::pi).epsilon(1e-5));
  CHECK(value("initial(u)") == 2.0);
  CHECK(value("final(free)") == Approx(20.0));
  CHECK(value("at(free, 12.3456 s)") == Approx(12.3456).epsilon(1e-12));
  CHECK(std::isnan(value("at(free, 21 s)")));
  // 40 half waves of 2*3 A each way.
  CHECK(value("total_variation(motor.i)") == Approx(240.0).epsilon(1e-9));
  // The sine at 0.5 s, 1 s, …, 19.5 s; where it ends at zero depends on rounding.
  CHECK(value("crossings(motor.i)", 19.75) == 39.0);
  // A polygon with angles of step: each side is short by step^2/24.
  CHECK(value("path_length(x1, x2)") == Approx(40.0).epsilon(1e-7));
}

TEST_CASE("Metric: conditions are counted by the time in which they hold") {
  // An interval at whose end the condition changes counts half: step/2 at each of 40 edges.
  CHECK(value("duration(motor.i > 1.5 A)") == Approx(20.0 / 3.0).margin(20 * step));
  CHECK(value("fraction(motor.i > 0 A or motor.i <= 0 A)") == Approx(1.0).epsilon(1e-12));
  CHECK(value("fraction(time >= 5 s and time < 10 s)") == Approx(0.25).margin(step / 20.0));
}

TEST_CASE("Metric: expressions over measures, and measures of expressions over measures") {
  CHECK(value("final(u) + 2*max(u)") == 6.0);
  CHECK(value("max(final(u), 5 V)") == 5.0);
  CHECK(value("min(final(u), initial(y))") == 0.0);
  CHECK(value("rms(motor.i - mean(motor.i))/max(abs(motor.i))") ==
        Approx(1.0 / std::sqrt(2.0)).epsilon(1e-12));
  CHECK(value("if(final(u) > 1 V, 1, 2)") == 1.0);
  CHECK(value("3") == 3.0);
}

TEST_CASE("Metric: a window of time") {
  CHECK(value("integral(free, from = 1 s, to = 3 s)") == Approx(4.0).epsilon(1e-12));
  CHECK(value("integral(free, from = 1.0005 s, to = 1.0007 s)") == Approx(2.0012e-4).epsilon(1e-9));
  CHECK(value("max(free, to = 7.00049 s)") == Approx(7.00049).epsilon(1e-12));
  CHECK(value("final(free, to = 2 s)") == Approx(2.0).epsilon(1e-12));
  CHECK(value("initial(free, from = 2.00025 s)") == Approx(2.00025).epsilon(1e-12));
  // Times count from the start of the window.
  CHECK(value("settling(y, from = 0.1 s, initial = 0 V)") == Approx(0.5 * std::log(50.0) - 0.1).margin(1e-6));
  CHECK(std::isnan(value("max(free, from = 21 s)")));
  CHECK(std::isnan(value("mean(free, from = 3 s, to = 2 s)")));
}

TEST_CASE("Metric: windows side by side share nothing of a jump") {
  Plan plan;
  plan.columns = {{"y", "1", -1}};
  Log log(plan);
  for (const auto& [t, y] :
       {std::pair(0.0, 0.0), std::pair(1.0, 0.0), std::pair(1.0, 5.0), std::pair(2.0, 5.0)})
    log.append_row({t, y});
  const auto of = [&](const std::string& text) { return Metric(text, log.columns()).evaluate(log); };
  CHECK(of("max(y, to = 1 s)") == 0.0);
  CHECK(of("min(y, from = 1 s)") == 5.0);
  CHECK(of("at(y, 1 s)") == 5.0);
  CHECK(of("max(y, from = 1 s, to = 1 s)") == 5.0);
  CHECK(of("integral(y)") == 5.0);
}

TEST_CASE("Metric: what has no answer is NaN") {
  CHECK(std::isnan(value("settling(y, final = 3 V)")));
  CHECK(std::isnan(value("rise(y, 0 V, 3 V)")));
  CHECK(std::isnan(value("overshoot(u)")));
  const Log empty = hand_made_log({{"y", "V", [](double) { return 0.0; }}}, -1.0, 1.0);
  for (const std::string text : {"final(y)", "max(y)", "settling(y)", "integral(y)", "mean(y)"})
    CHECK(std::isnan(Metric(text, empty.columns()).evaluate(empty)));
}

TEST_CASE("Metric: units are carried through") {
  CHECK(unit("overshoot(y)") == "1");
  CHECK(unit("settling(y)") == "s");
  CHECK(unit("integral(u^2)") == unit("effort(u)"));
  CHECK(unit("effort(x1)") == "m^2*s");
  CHECK(unit("ITAE(x1)") == "m*s^2");
  CHECK(unit("ITSE(x1)") == "m^2*s^2");
  CHECK(unit("max(u*motor.i)") == "W");
  CHECK(unit("integral(u*motor.i)") == "J");
  CHECK(unit("path_length(x1, x2)/settling(y)") == "m/s");
  CHECK(unit("max(free)").empty());
  CHECK(unit("crossings(free)") == "1");
  CHECK(unit("integral(time)") == "s^2");
  CHECK(unit("steps()") == "1");
}

TEST_CASE("Metric: counts of the solver") {
  const Log log = sample(0.0);
  RunStatistics statistics;
  statistics.stepper.steps = 120;
  statistics.stepper.rate_evaluations = 800;
  statistics.hits = 7;
  statistics.events = 3;
  const Metric metric("evaluations() + 1e3*hits() + 1e5*events() + 1e7*steps()", log.columns());
  CHECK(metric.evaluate(log, statistics) == 1200307800.0);
}

TEST_CASE("Metric: which read the last row only") {
  const auto end_only = [](const std::string& text) {
    return Metric(text, sample(0.0).columns()).reads_end_only();
  };
  CHECK(end_only("final(u*y)/final(y)^2 + final(x1)/final(x2) + 3"));
  CHECK(end_only("final(y - final(u))"));
  CHECK(end_only("steady_state_error(y, u)"));
  CHECK_FALSE(end_only("final(y, to = 1 s)"));
  CHECK_FALSE(end_only("final(y - mean(y))"));
  CHECK_FALSE(end_only("steps()"));
}

TEST_CASE("Metric: distance from a path, and angles that wrap") {
  const test::TemporaryFolder folder;
  write_file(folder / "path.csv", "x [m],y [m]\n0,0\n10,0\n10,10\n");
  const Log log = hand_made_log({{"x", "m", [](double t) { return t; }},
                                 {"y", "m", [](double) { return 2.0; }},
                                 {"leg", "1", [](double t) { return t < 10.5 ? 1.0 : 2.0; }},
                                 {"heading", "rad", [](double t) { return t; }}},
                                12.0, 1.0);
  const auto of = [&](const std::string& text) {
    return Metric(text, log.columns(), folder / ".").evaluate(log);
  };
  CHECK(of("max(cross_track(x, y, \"path.csv\"))") == 2.0);
  // At x = 9 m the second leg is nearer than the first.
  CHECK(of("at(cross_track(x, y, \"path.csv\"), 9 s)") == 1.0);
  CHECK(of("at(cross_track(x, y, 'path.csv', leg), 9 s)") == 2.0);
  CHECK(of("at(line_distance(x, y, \"path.csv\", leg), 12 s)") == 2.0);
  CHECK(of("at(line_distance(x, y, \"path.csv\", 1), 12 s)") == 2.0);
  CHECK(of("at(cross_track(x, y, \"path.csv\", 1), 12 s)") == Approx(std::hypot(2.0, 2.0)));
  CHECK(of("at(wrap(heading), 4 s)") == Approx(4.0 - 2.0 * std::numbers::pi));
  CHECK(of("at(heading_error(heading, 8), 1 s)") == Approx(2.0 * std::numbers::pi - 7.0));
}

TEST_CASE("Metric: what is wrong is said where it is") {
  CHECK(refusal("final(z)") == "6: unknown name \"z\"; known: free, motor.i, s, time, u, x1, x2, y");
  CHECK(refusal("1 + oversoot(y)") == "4: unknown function \"oversoot\"; did you mean \"overshoot\"?");
  CHECK(refusal("2*y") ==
        "2: y changes over time: say which number of it is meant, such as final(y) or max(y)");
  CHECK(refusal("max(abs(motor.i)) + 2 V") == "18: A and V cannot be added or compared");
  CHECK(refusal("max(u + motor.i)") == "6: V and A cannot be added or compared");
  CHECK(refusal("settling(y, 2 s)") == "12: expected a plain number, found s");
  CHECK(refusal("settling(y, 2 %, final = 2 A)") == "25: expected V, found A");
  CHECK(refusal("max(y, from = 2 V)") == "14: expected s, found V");
  CHECK(refusal("settling(y, 2 %, finl = 2 V)").starts_with("17: "));
  CHECK(refusal("settling(y, 2 %, finl = 2 V)").ends_with("did you mean \"final\"?"));
  CHECK(refusal("overshoot(y, 0 V, 1 V, 2)") ==
        "10: too many arguments: expected overshoot(y[, initial, final]), found 4");
  CHECK(refusal("path_length(x1)") == "12: y is missing in path_length(x, y)");
  CHECK(refusal("path_length(x1, u)") == "16: expected m, found V");
  CHECK(refusal("rise(y, initial = 0 V, initial = 1 V)") == "23: initial is given twice");
  CHECK(refusal("settling(y, mean(y) + y)").starts_with("22: "));
  CHECK(refusal("duration(y)") == "9: expected a condition such as a > b, found a number");
  CHECK(refusal("max(wrap(y))").starts_with("9: "));
  CHECK(refusal("wrap(free)") ==
        "0: wrap(angle) changes over time: say which number of it is meant, such as max(…) or rms(…)");
  CHECK(refusal("final(y) final(u)") == "9: unexpected \"f\"");
  CHECK(refusal("final(y") == "7: expected \")\": the expression ends too early");
  CHECK(refusal("final()") == "6: x is missing in final(x)");
  CHECK(refusal("") == "0: the expression ends too early");
  CHECK(refusal("steps(from = 2 s)").starts_with("6: "));
  CHECK(refusal("max(cross_track(x1, x2, \"nothing.csv\"))") ==
        "24: the file does not serve: nothing.csv: error: cannot be read: No such file or directory");
}

TEST_CASE("Metric: nesting has an end") {
  std::string open, close;
  for (int k = 0; k < 10'000; ++k) {
    open += "max(";
    close += ')';
  }
  CHECK(refusal(open + "y" + close).ends_with("calls are nested too deeply"));
  CHECK(refusal(open + "y").ends_with("the expression is nested too deeply"));
}

TEST_CASE("Metric: behind a number a unit comes before a signal of the same name") {
  CHECK(value("at(free, 2 s)") == Approx(2.0));
  CHECK(value("max(s*2)") == Approx(40.0));
}

TEST_CASE("Metric: every measure says what it is") {
  for (const Measure& measure : measures()) {
    INFO(measure.name);
    CHECK_FALSE(measure.doc.empty());
    CHECK((measure.value != nullptr) != (measure.series != nullptr));
    CHECK(find_measure(measure.name) == &measure);
  }
  CHECK(find_measure("settling")->signature() == "settling(y[, band, final, initial])");
  CHECK(find_measure("iae") == find_measure("IAE"));
}
