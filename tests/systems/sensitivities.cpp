#include "solvers/sensitivities.h"

#include <cmath>
#include <limits>
#include <thread>

#include "tests/systems/blocks.h"
#include "tests/systems/harness.h"

using namespace flyball;
using namespace flyball::test;

namespace {

/// What the design promises against closed forms; derivatives here are of the order of 1.
constexpr double promised = 5e-10;

std::vector<double> grid(double stop, int parts) {
  std::vector<double> times;
  for (int k = 0; k <= parts; ++k) times.push_back(stop * k / parts);
  return times;
}

Sensitivities sensitivities(const Model& model, std::vector<std::string> parameters,
                            std::vector<std::string> signals, std::vector<double> times) {
  return Sensitivities(model.plan, model.settings,
                       {std::move(parameters), std::move(signals), std::move(times)});
}

/// Runs at the model's values and compares the one signal with `closed(t, parameters)`, a closed form on
/// Jets.
template <class Closed>
void check_closed_form(const Model& model, const SensitivityRequest& request, Closed&& closed,
                       double tolerance = promised) {
  Sensitivities run(model.plan, model.settings, request);
  run.run(run.model_values());
  CHECK(run.warnings().empty());
  const int count = static_cast<int>(request.parameters.size());
  for (int p = 0; p < count; ++p) {
    std::vector<Jet> parameters;
    for (int q = 0; q < count; ++q) parameters.emplace_back(run.model_values()[q]);
    parameters[p].v[0] = 1.0;
    for (int k = 0; k < static_cast<int>(request.times.size()); ++k) {
      const Jet wanted = closed(request.times[k], parameters);
      INFO(request.parameters[p] << " at t = " << request.times[k]);
      CHECK(std::fabs(run.value(k, 0) - wanted.a) < tolerance);
      CHECK(std::fabs(run.derivative(k, 0, p) - wanted.v[0]) < tolerance);
    }
  }
}

using Jets = std::vector<Jet>;

}  // namespace

TEST_CASE("Sensitivities of a decay by its rate and its start, expressions included") {
  const Model model = read_model(R"toml(
flyball = 1
[parameters]
k = 0.7
x0 = 2.0
[blocks]
loss = { type = "Gain", gain = "-k*k" }
x = { type = "Integrator", initial = "3*x0" }
[diagram]
wires = ["x -> loss -> x"]
log = ["x", "loss"]
[simulation]
stop = 5
)toml");
  const auto x = [](double t, const Jets& p) { return 3.0 * p[1] * exp(-p[0] * p[0] * t); };
  check_closed_form(model, {{"k", "x0"}, {"x"}, grid(5.0, 50)}, x);
  check_closed_form(model, {{"k", "x0"}, {"loss"}, grid(5.0, 50)},
                    [&](double t, const Jets& p) { return -p[0] * p[0] * x(t, p); });
}

TEST_CASE("A parameter of 0 on a signal at rest: the derivative alone limits the steps") {
  const Model model = read_model(R"toml(
flyball = 1
[blocks]
b = { type = "Constant", value = 0.0 }
net = { type = "Sum", signs = "+-" }
fast = { type = "Gain", gain = 40.0 }
x = { type = "Integrator" }
[diagram]
wires = ["b -> net.u1", "x -> net.u2", "net -> fast -> x"]
log = ["x"]
[simulation]
stop = 100
)toml");
  check_closed_form(model, {{"b.value"}, {"x"}, grid(100.0, 1000)},
                    [](double t, const Jets& p) { return p[0] * (1.0 - std::exp(-40.0 * t)); });
}

TEST_CASE("Sensitivities of a ball through its bounces") {
  const Model model = read_model(R"toml(
flyball = 1
[blocks]
ball = { type = "BouncingBall", gravity = 9.81, restitution = 0.8, initial_height = 1.0 }
[diagram]
log = ["ball.height", "ball.velocity"]
[simulation]
stop = 3.5
)toml");
  // Bounce n at T (1 + 2 (r + ... + r^n)) with the speed sqrt(2 g h) r^(n+1) behind it.
  const auto flight = [](double t, const Jets& p) {
    const Jet &g = p[0], &r = p[1], &h = p[2];
    struct {
      Jet begin, speed, height;
    } now{Jet(0.0), Jet(0.0), h};
    Jet bounce = sqrt(2.0 * h / g), speed = sqrt(2.0 * g * h);
    while (bounce.a < t) {
      speed *= r;
      now = {bounce, speed, Jet(0.0)};
      bounce += 2.0 * speed / g;
    }
    return now;
  };
  const std::vector<std::string> names = {"ball.gravity", "ball.restitution", "ball.initial_height"};
  // The grid keeps away from bounces: at one the velocity has no derivative.
  check_closed_form(model, {names, {"ball.height"}, grid(3.5, 70)}, [&](double t, const Jets& p) {
    const auto now = flight(t, p);
    const Jet s = t - now.begin;
    return now.height + now.speed * s - p[0] * s * s / 2.0;
  });
  check_closed_form(model, {names, {"ball.velocity"}, grid(3.5, 70)}, [&](double t, const Jets& p) {
    const auto now = flight(t, p);
    return now.speed - p[0] * (t - now.begin);
  });
}

TEST_CASE("Sensitivities through the switches of a relay") {
  const Model model = read_model(R"toml(
flyball = 1
[blocks]
relay = { type = "Relay", switch_on = 0.6, switch_off = 0.4, on = 0.1, off = 1.0 }
loss = { type = "Sum", signs = "+-" }
x = { type = "Integrator" }
[diagram]
wires = ["relay -> loss.u1", "x -> loss.u2", "loss -> x -> relay"]
log = ["x"]
[simulation]
stop = 4
)toml");
  // x' = u - x from a switch on. More than three parameters: two passes.
  check_closed_form(
      model,
      {{"relay.switch_on", "relay.switch_off", "relay.on", "relay.off", "x.initial"}, {"x"}, grid(4.0, 37)},
      [](double t, const Jets& p) {
        Jet begin(0.0), x = p[4], u = p[3];
        for (bool on = false;; on = !on) {
          const Jet& level = on ? p[1] : p[0];
          const Jet next = begin + log((x - u) / (level - u));
          if (next.a > t) return u + (x - u) * exp(begin - t);
          begin = next;
          x = level;
          u = on ? p[3] : p[2];
        }
      });
}

TEST_CASE("Sensitivities of a stiff diagram, by BDF, through the switches of a relay") {
  // w follows x within 1e-5 s, which keeps a Dormand-Prince step below 4e-5 s.
  const Model model = read_model(R"toml(
flyball = 1
[blocks]
relay = { type = "Relay", switch_on = 0.6, switch_off = 0.4, on = 0.1, off = 1.0 }
loss = { type = "Sum", signs = "+-" }
x = { type = "Integrator" }
lag = { type = "Sum", signs = "+-" }
fast = { type = "Gain", gain = 1e5 }
w = { type = "Integrator" }
[diagram]
wires = ["relay -> loss.u1", "x -> loss.u2", "loss -> x -> relay", "x -> lag.u1", "w -> lag.u2", "lag -> fast -> w"]
log = ["w"]
[simulation]
stop = 4
solver = { method = "bdf" }
)toml");
  // x = u + c exp(-s) in the time s since a switch; w the same with L/(L - 1) c, but for 1e-4 s after it.
  // BDF makes some 1000 steps of 1e-10 each here.
  check_closed_form(
      model, {{"relay.switch_on", "relay.switch_off", "fast.gain", "x.initial"}, {"w"}, grid(4.0, 37)},
      [](double t, const Jets& p) {
        if (t == 0.0) return Jet(0.0);
        Jet begin(0.0), x = p[3], u(1.0);
        for (bool on = false;; on = !on) {
          const Jet& level = on ? p[1] : p[0];
          const Jet next = begin + log((x - u) / (level - u));
          if (next.a > t) return u + p[2] / (p[2] - 1.0) * (x - u) * exp(begin - t);
          begin = next;
          x = level;
          u = Jet(on ? 1.0 : 0.1);
        }
      },
      1e-7);
}

TEST_CASE("Sensitivities by the time of a step and the edges of pulses") {
  const Model step = read_model(R"toml(
flyball = 1
[blocks]
step = { type = "Step", time = 0.5, before = 0.2, after = 3.0 }
net = { type = "Sum", signs = "+-" }
x = { type = "Integrator", initial = 1.0 }
[diagram]
wires = ["step -> net.u1", "x -> net.u2", "net -> x"]
log = ["x"]
[simulation]
stop = 4
)toml");
  check_closed_form(
      step, {{"step.time", "step.before", "step.after"}, {"x"}, grid(4.0, 33)}, [](double t, const Jets& p) {
        const auto at = [&](const Jet& s, const Jet& x, const Jet& u) { return u + (x - u) * exp(-s); };
        if (t < p[0].a) return at(Jet(t), Jet(1.0), p[1]);
        return at(t - p[0], at(p[0], Jet(1.0), p[1]), p[2]);
      });

  const Model pulses = read_model(R"toml(
flyball = 1
[blocks]
pulse = { type = "PulseGenerator", amplitude = 2.0, period = 0.7, duty = 0.3, delay = 0.2 }
x = { type = "Integrator" }
[diagram]
wires = ["pulse -> x"]
log = ["x"]
[simulation]
stop = 3
)toml");
  check_closed_form(pulses,
                    {{"pulse.amplitude", "pulse.period", "pulse.duty", "pulse.delay"}, {"x"}, grid(2.9, 31)},
                    [](double t, const Jets& p) {
                      Jet sum(0.0);
                      for (double k = 0.0; p[3].a + k * p[1].a < t; ++k) {
                        const Jet begin = p[3] + k * p[1], width = p[2] * p[1];
                        sum += p[0] * (begin.a + width.a < t ? width : t - begin);
                      }
                      return sum;
                    });
}

TEST_CASE("Sensitivities of a sampled PI controller: ticks do not move") {
  const Model model = read_model(R"toml(
flyball = 1
[blocks]
wanted = { type = "Constant", value = 1.0 }
error = { type = "Sum", signs = "+-" }
control = { type = "DiscretePID", sample_time = "1/10 s", Kp = 3.0, Ki = 2.0 }
x = { type = "Integrator", initial = 0.3 }
[diagram]
wires = ["wanted -> error.u1", "x -> error.u2", "error -> control -> x"]
log = ["x", "control"]
[simulation]
stop = 2
)toml");
  const auto loop = [](double t, const Jets& p, bool of_control) {
    Jet x = p[3], integral(0.0), u(0.0);
    for (int k = 0;; ++k) {
      integral += p[1] * 0.1 * (p[2] - x);
      u = p[0] * (p[2] - x) + integral;
      if (t < 0.1 * (k + 1) - 1e-9) return of_control ? u : x + u * (t - 0.1 * k);
      x += 0.1 * u;
    }
  };
  const std::vector<std::string> names = {"control.Kp", "control.Ki", "wanted.value", "x.initial"};
  check_closed_form(model, {names, {"x"}, grid(2.0, 64)},
                    [&](double t, const Jets& p) { return loop(t, p, false); });
  check_closed_form(model, {names, {"control"}, grid(2.0, 64)},
                    [&](double t, const Jets& p) { return loop(t, p, true); });
}

TEST_CASE("Sensitivities through algebraic loops, during steps and at hits") {
  // z = k (x - z), x' = z; and the same from a sampled x, where the loop is solved at hits only.
  const Model model = read_model(R"toml(
flyball = 1
[parameters]
k = 0.6
[blocks]
x = { type = "Integrator", initial = 2.0 }
net = { type = "Sum", signs = "+-" }
z = { type = "Gain", gain = "k" }
sampled_x = { type = "Integrator", initial = 2.0 }
hold = { type = "ZeroOrderHold", sample_time = "1/4 s" }
sampled_net = { type = "Sum", signs = "+-" }
sampled_z = { type = "Gain", gain = "k" }
[diagram]
wires = ["x -> net.u1", "z -> net.u2", "net -> z -> x",
         "sampled_x -> hold -> sampled_net.u1", "sampled_z -> sampled_net.u2", "sampled_net -> sampled_z -> sampled_x"]
log = ["x", "sampled_x"]
[simulation]
stop = 1.9
)toml");
  const auto factor = [](const Jets& p) { return p[0] / (1.0 + p[0]); };
  check_closed_form(model, {{"k", "x.initial"}, {"x"}, grid(1.9, 23)},
                    [&](double t, const Jets& p) { return p[1] * exp(factor(p) * t); });
  check_closed_form(model, {{"k", "sampled_x.initial"}, {"sampled_x"}, grid(1.9, 23)},
                    [&](double t, const Jets& p) {
                      Jet x = p[1];
                      for (; t > 0.25; t -= 0.25) x *= 1.0 + 0.25 * factor(p);
                      return x * (1.0 + t * factor(p));
                    });
}

TEST_CASE("Sensitivities through a saturation, whose limit the signal leaves on the way") {
  const Model model = read_model(R"toml(
flyball = 1
[blocks]
one = { type = "Constant", value = 1.0 }
error = { type = "Sum", signs = "+-" }
k = { type = "Gain", gain = 5.0 }
limit = { type = "Saturation", lower = -1.0, upper = 0.8 }
x = { type = "Integrator" }
[diagram]
wires = ["one -> error.u1", "x -> error.u2", "error -> k -> limit -> x"]
log = ["x"]
[simulation]
stop = 3
)toml");
  check_closed_form(model, {{"k.gain", "limit.upper", "one.value"}, {"x"}, grid(3.0, 40)},
                    [](double t, const Jets& p) {
                      const Jet meets = p[2] - p[1] / p[0], when = meets / p[1];
                      if (t < when.a) return p[1] * t;
                      return p[2] - (p[2] - meets) * exp(-p[0] * (t - when));
                    });
}

TEST_CASE("Balls that bounce at one time are parted by their parameters, and told of") {
  const Model model = read_model(R"toml(
flyball = 1
[blocks]
a = { type = "BouncingBall" }
b = { type = "BouncingBall" }
[diagram]
log = ["a.height", "b.height"]
[simulation]
stop = 1
)toml");
  Sensitivities run =
      sensitivities(model, {"a.initial_height", "b.restitution"}, {"a.height", "b.height"}, {0.3, 0.9});
  run.run(run.model_values());
  // h = v s - g s^2/2 with v = r sqrt(2 g h0), s = t - sqrt(2 h0/g), for h0 = 1.
  const double g = 9.81, T = std::sqrt(2.0 / g), r = 0.8, s = 0.9 - T, v = r * std::sqrt(2.0 * g);
  CHECK(std::fabs(run.derivative(1, 0, 0) - (v / 2.0 * s - (v - g * s) * T / 2.0)) < promised);
  CHECK(std::fabs(run.derivative(1, 1, 1) - v / r * s) < promised);
  CHECK(run.derivative(1, 0, 1) == 0.0);
  CHECK(run.derivative(1, 1, 0) == 0.0);
  REQUIRE(run.warnings().size() == 1);
  CHECK(run.warnings()[0].kind == SensitivityWarning::Kind::one_sided);
  CHECK(run.warnings()[0].parameter == 0);
  CHECK(std::fabs(run.warnings()[0].time - T) < 1e-9);
  CHECK_THAT(run.warnings()[0].message,
             Catch::StartsWith("crossing a.ground and crossing b.ground are at one time at t = 0.451"));
  CHECK_THAT(run.warnings()[0].message, Catch::EndsWith("the derivative by a.initial_height is one-sided"));
}

TEST_CASE("A step on a sample hit comes after it: the derivative is the one-sided one") {
  const Model model = read_model(R"toml(
flyball = 1
[blocks]
step = { type = "Step", time = 1.0 }
x = { type = "Integrator" }
hold = { type = "ZeroOrderHold", sample_time = "1/2 s" }
sum = { type = "Integrator" }
[diagram]
wires = ["step -> x -> hold -> sum"]
log = ["x", "sum"]
[simulation]
stop = 2
)toml");
  Sensitivities run = sensitivities(model, {"step.time"}, {"x", "sum"}, {0.75, 1.75});
  run.run(run.model_values());
  CHECK(run.derivative(0, 0, 0) == 0.0);
  CHECK(std::fabs(run.derivative(1, 0, 0) + 1.0) < promised);
  // x(1.5) = 1.5 - time is held from 1.5 on; x(1) is 0 for later times, too.
  CHECK(std::fabs(run.derivative(1, 1, 0) + 0.25) < promised);
  REQUIRE(run.warnings().size() == 1);
  CHECK(run.warnings()[0].message ==
        "a sample hit and alarm step.jump are at one time at t = 1 s: the derivative by step.time is "
        "one-sided");
}

TEST_CASE("A signal that only touches its threshold has no derivative from there on") {
  // x = t - t^2/2 has its top of 1/2 at the hit at t = 1, a rounding above the level.
  const Model model = read_model(R"toml(
flyball = 1
[blocks]
pull = { type = "Constant", value = -1.0 }
v = { type = "Integrator", initial = 1.0 }
x = { type = "Integrator" }
relay = { type = "Relay", switch_on = "0.5 - 1e-13", switch_off = -10.0 }
y = { type = "Integrator", initial = 3.0 }
tick = { type = "ZeroOrderHold", sample_time = 1.0 }
[diagram]
wires = ["pull -> v -> x -> relay -> y -> tick"]
log = ["y", "x"]
[simulation]
stop = 2
)toml");
  Sensitivities run = sensitivities(model, {"v.initial", "y.initial"}, {"y", "x"}, {0.5, 1.5});
  run.run(run.model_values());
  CHECK(run.value(1, 0) > 3.4);
  CHECK(run.derivative(0, 0, 0) == 0.0);
  CHECK(std::isnan(run.derivative(1, 0, 0)));
  CHECK(std::isnan(run.derivative(1, 1, 0)));
  CHECK(std::fabs(run.derivative(1, 0, 1) - 1.0) < promised);
  REQUIRE(run.warnings().size() == 1);
  CHECK(run.warnings()[0].kind == SensitivityWarning::Kind::grazing);
  CHECK_THAT(run.warnings()[0].message,
             Catch::StartsWith("relay.turns_on only touches its threshold at t = 0.99"));
  CHECK_THAT(run.warnings()[0].message, Catch::EndsWith("there is no derivative by v.initial from then on"));
}

namespace {

/// On double alone: what it does is not differentiated.
struct Twice : Block {
  static constexpr auto summary = "Twice its input, at its hits.";
  static constexpr bool differentiable = false;
  SampleTime ts = sample_time();
  Input u = input("u", "any", "signal");
  Output y = output("y", "any", "twice the signal");
  void outputs(auto& v) const { v[y] = 2.0 * v[u]; }
};

const char* const thermostat = R"toml(
flyball = 1
[parameters]
d = 0.1
twice = "2*d"
size = 2.0
[blocks]
relay = { type = "Relay", switch_on = "d", switch_off = "-d", on = -1.0, off = 1.0 }
x = { type = "Integrator" }
hold = { type = "ZeroOrderHold", sample_time = "size/10" }
[diagram]
wires = ["relay -> x -> relay, hold"]
log = ["x"]
[simulation]
stop = 3
)toml";

std::string refusal(const std::string& parameter, const std::string& signal, std::vector<double> times) {
  try {
    sensitivities(read_model(thermostat), {parameter}, {signal}, std::move(times));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("What a handler takes over at an event moves with the event") {
  // x = c t - 1 passes 0 at t = 1/c. There `when` takes the time. Later `same` takes another 4 for its own 4,
  // which changes no number.
  DiagramBuilder diagram;
  diagram.add("Constant", "c", {{"value", 2.0}});
  diagram.add("Integrator", "x", {{"initial", -1.0}});
  diagram.add("Integrator", "later", {{"initial", -1.2}});
  diagram.add("Clock", "clock");
  diagram.add("Constant", "four", {{"value", 4.0}});
  diagram.add<Exchange>("when");
  diagram.add<Exchange>("same", {{"initial", 4.0}});
  diagram.add("Gain", "k", {{"gain", 3.0}});
  diagram.add("Gain", "k_same", {{"gain", 3.0}});
  diagram.wire("c.y", "x.u");
  diagram.wire("c.y", "later.u");
  diagram.wire("x.y", "when.trigger");
  diagram.wire("later.y", "same.trigger");
  diagram.wire("clock.y", "when.other");
  diagram.wire("four.y", "same.other");
  diagram.wire("when.y", "k.u");
  diagram.wire("same.y", "k_same.u");
  diagram.log("k.y");
  diagram.log("k_same.y");
  diagram.simulation.stop = 1.0;
  Sensitivities run = sensitivities(diagram.build(), {"c.value", "four.value", "same.initial"},
                                    {"k.y", "k_same.y"}, {0.25, 0.75});
  run.run(run.model_values());
  CHECK(run.warnings().empty());
  CHECK(std::fabs(run.value(1, 0) - 1.5) < promised);
  CHECK(std::fabs(run.derivative(1, 0, 0) + 0.75) < promised);
  CHECK(run.derivative(0, 1, 2) == 3.0);
  CHECK(run.derivative(0, 1, 1) == 0.0);
  CHECK(run.derivative(1, 1, 2) == 0.0);
  CHECK(run.derivative(1, 1, 1) == 3.0);
}

TEST_CASE("What cannot be differentiated is refused with its reason") {
  CHECK(refusal("e", "x", {1.0}) == "there is no parameter e");
  CHECK(refusal("twice", "x", {1.0}) == "twice is computed from other parameters");
  CHECK(refusal("size", "x", {1.0}) == "size fixes the structure of a block: it takes a new plan");
  CHECK(refusal("d", "relay", {1.0}) == "relay is not logged");
  CHECK(refusal("d", "x", {1.0, 0.5}) == "times must ascend");
  CHECK(refusal("d", "x", {1.0, 3.5}) == "times must be between 0 and the stop time 3 s");
  CHECK(refusal("d", "x", {}) == "times must be between 0 and the stop time 3 s");
  CHECK(refusal("d", "x", {1.0}) == "accepted");
}

TEST_CASE("A block on double alone passes no derivative on, and that is told") {
  DiagramBuilder diagram;
  diagram.add("Constant", "c", {{"value", 3.0}});
  diagram.add("Constant", "d", {{"value", 1.0}});
  diagram.add<Twice>("twice", {{"sample_time", *Rational::fraction(1, 2)}});
  diagram.add("Sum", "sum", {{"signs", std::string("+++")}});
  diagram.wire("c.y", "twice.u");
  diagram.wire("twice.y", "sum.u1");
  diagram.wire("c.y", "sum.u2");
  diagram.wire("d.y", "sum.u3");
  diagram.log("sum.y");
  diagram.simulation.stop = 1.0;
  Sensitivities run = sensitivities(diagram.build(), {"c.value", "d.value"}, {"sum.y"}, {0.75});
  run.run(run.model_values());
  CHECK(run.value(0, 0) == 10.0);
  CHECK(run.derivative(0, 0, 0) == 1.0);
  CHECK(run.derivative(0, 0, 1) == 1.0);
  REQUIRE(run.warnings().size() == 1);
  CHECK(run.warnings()[0].kind == SensitivityWarning::Kind::opaque);
  CHECK(
      run.warnings()[0].message ==
      "twice passes no derivative on at t = 0 s: the derivative by c.value leaves out what goes through it");
}

TEST_CASE("A derivative that is not finite stops the run and is named") {
  const Model model = read_model(R"toml(
flyball = 1
[blocks]
root = { type = "Expression", inputs = ["x"], formula = "sqrt(x)" }
x = { type = "Integrator" }
rest = { type = "Constant", value = 0.0 }
[diagram]
wires = ["rest -> x -> root"]
log = ["root"]
[simulation]
stop = 1
)toml");
  Sensitivities run = sensitivities(model, {"x.initial"}, {"root"}, {0.5});
  CHECK_THROWS_WITH(run.run(std::vector<double>{0.0}),
                    "the derivative of root.y by x.initial is inf at t = 0.5 s");
  CHECK_THROWS_WITH(run.run({}), "expected 1 parameters, found 0");
  run.run(std::vector<double>{4.0});
  CHECK(run.derivative(0, 0, 0) == 0.25);
}

TEST_CASE("One object serves many values, and gives what a new one gives, on any thread") {
  const Model model = read_model(thermostat);
  const auto derivatives = [&](std::vector<double> at) {
    Sensitivities run =
        sensitivities(model, {"d", "relay.on", "x.initial", "relay.off"}, {"x"}, grid(3.0, 7));
    run.run(std::vector<double>{0.2, -1.3, 0.0, 0.9});
    run.run(at);
    return run.derivatives();
  };
  const std::vector<double> at = {0.15, -1.0, 0.01, 1.1};
  Sensitivities fresh =
      sensitivities(model, {"d", "relay.on", "x.initial", "relay.off"}, {"x"}, grid(3.0, 7));
  fresh.run(at);
  std::vector<double> others[2];
  std::thread first([&] { others[0] = derivatives(at); }), second([&] { others[1] = derivatives(at); });
  first.join();
  second.join();
  CHECK(others[0] == fresh.derivatives());
  CHECK(others[1] == fresh.derivatives());
  CHECK_THROWS_AS(fresh.run(std::vector<double>{std::nan(""), -1.0, 0.0, 1.0}), std::invalid_argument);
}

TEST_CASE("S37: sensitivities go through a loop whose bits change") {
  // y = sat(g (t - y)) is g t/(1 + g) up to t = 1 + 1/g, then 1; x is its integral.
  const Model model = read_model(R"toml(
flyball = 1
[parameters]
g = 4.0
[blocks]
t = { type = "Clock" }
error = { type = "Sum", signs = "+-" }
gain = { type = "Gain", gain = "g" }
limit = { type = "Saturation" }
x = { type = "Integrator" }
[diagram]
wires = ["t -> error.u1", "error -> gain -> limit -> error.u2", "limit -> x"]
log = ["x"]
[simulation]
stop = 2
)toml");
  check_closed_form(model, {{"g"}, {"x"}, grid(2.0, 7)}, [](double t, const Jets& p) {
    const Jet ends = 1.0 + 1.0 / p[0];
    const Jet slope = p[0] / (1.0 + p[0]);
    return t < ends.a ? 0.5 * slope * t * t : 0.5 * ends + (t - ends);
  });
}
