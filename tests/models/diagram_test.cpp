#include "models/diagram.h"

#include <algorithm>

#include "models/language/expression.h"
#include "tests/catch.h"

using namespace flyball;

namespace {

Diagram diagram(std::string_view text, const std::vector<Override>& overrides = {}) {
  Diagnostics diagnostics("model.toml");
  auto result = read_diagram(text, diagnostics, overrides);
  for (const Diagnostic& diagnostic : diagnostics.sorted()) UNSCOPED_INFO(to_string(diagnostic));
  REQUIRE(result.has_value());
  return *std::move(result);
}

const Instance& block(const Diagram& diagram, std::string_view name) {
  REQUIRE(diagram.find_instance(name) >= 0);
  return diagram.instances[diagram.find_instance(name)];
}

const Binding& parameter(const Diagram& diagram, std::string_view of, std::string_view name) {
  const Instance& instance = block(diagram, of);
  for (const auto& [slot, binding] : instance.parameters) {
    if (instance.object->specification->slots[slot].name == name) return binding;
  }
  FAIL("no such parameter");
  throw;
}

/// "block.slot" of what drives an input, "" if nothing does.
std::string source(const Diagram& diagram, std::string_view of, std::string_view input) {
  const Instance& instance = block(diagram, of);
  for (const auto& [slot, endpoint] : instance.inputs) {
    if (instance.object->specification->slots[slot].name != input) continue;
    if (!endpoint.connected()) return "";
    const Instance& from = diagram.instances[endpoint.instance];
    return from.name + "." + from.object->specification->slots[endpoint.slot].name;
  }
  return "no such input";
}

std::vector<std::string> logged(const Diagram& diagram) {
  std::vector<std::string> names;
  for (const Logged& signal : diagram.logged) names.push_back(signal.name);
  return names;
}

using Names = std::vector<std::string>;

const std::string arc = R"toml(flyball = 1
[model]
title  = "Arc follower"
source = "Ma, Liu, Yu, Cao 2018, eq. 24"
[parameters]
turn    = "-2*V/L"
V       = { value = "500 mm/s", doc = "mean wheel speed" }
L       = { value = "300 mm" }
K_H     = { value = 2.0, unit = "1/m" }
K_gamma = { value = 0.5, range = [0.0, 5.0] }
same    = "V"
[blocks]
H     = { type = "Integrator", initial = "50 mm" }
gamma = { type = "Integrator" }
sine  = { type = "TrigonometricFunction", function = "sin" }
speed = { type = "Gain", gain = "V" }
E     = { type = "Sum", signs = "++" }
K1    = { type = "Gain", gain = "K_gamma" }
K2    = { type = "Gain", gain = "K_H" }
turning = { type = "Gain", gain = "-2*V/L" }
[diagram]
wires = [
  "gamma -> sine -> speed -> H",
  "gamma -> K1 -> E.u1",
  "H -> K2 -> E.u2",
  "E -> turning -> gamma",
]
log = ["H", "gamma.y"]
[simulation]
stop   = "10 s"
solver = { method = "adams", rtol = 1e-8, atol = 1e-10, max_step = "50 ms", step = 0.001 }
log_interval = "1/3 s"
)toml";

}  // namespace

TEST_CASE("a model becomes a diagram") {
  const Diagram d = diagram(arc);
  CHECK(d.file == "model.toml");
  CHECK(d.title == "Arc follower");
  CHECK(d.source == "Ma, Liu, Yu, Cao 2018, eq. 24");
  CHECK(d.instances.size() == 8);
  CHECK(block(d, "sine").at == Position{15, 1});
  CHECK(source(d, "sine", "u") == "gamma.x");
  CHECK(source(d, "speed", "u") == "sine.y");
  CHECK(source(d, "H", "u") == "speed.y");
  CHECK(source(d, "E", "u1") == "K1.y");
  CHECK(source(d, "E", "u2") == "K2.y");
  CHECK(source(d, "gamma", "u") == "turning.y");
  CHECK(logged(d) == Names{"H", "gamma.y"});
  CHECK(d.find_instance("nothing") == -1);
  CHECK(d.find_parameter("nothing") == -1);
}

TEST_CASE("simulation settings are read, and keep their defaults") {
  const SimulationSettings given = diagram(arc).simulation;
  CHECK(given.stop == 10.0);
  CHECK(given.method == "adams");
  CHECK(given.rtol == 1e-8);
  CHECK(given.atol == 1e-10);
  CHECK(given.max_step == 0.05);
  CHECK(given.step == 0.001);
  CHECK(given.log_interval == Rational::fraction(1, 3));
  const SimulationSettings standard = diagram("flyball = 1\n[blocks]\n").simulation;
  CHECK(standard.method == "auto");
  CHECK(standard.rtol == 1e-6);
  CHECK_FALSE(standard.max_step.has_value());
  CHECK_FALSE(standard.log_interval.has_value());
}

TEST_CASE("parameters are sorted so that a formula uses earlier ones only") {
  const Diagram d = diagram(arc);
  Names names;
  for (const Parameter& p : d.parameters) names.push_back(p.name);
  CHECK(names == Names{"V", "L", "turn", "K_H", "K_gamma", "same"});
  const Binding& turn = d.parameters[2].binding;
  CHECK(turn.kind == Binding::Kind::formula);
  CHECK(turn.operands == std::vector<int>{0, 1});
  CHECK(evaluate(*turn.formula, std::vector<double>{0.5, 0.25}) == -4.0);
  CHECK(d.parameters[0].binding.value == 0.5);
  CHECK(d.parameters[0].unit == "m/s");
  CHECK(d.parameters[0].doc == "mean wheel speed");
  CHECK(d.parameters[2].unit == "1/s");
  CHECK(d.parameters[3].unit == "1/m");
  CHECK(d.parameters[4].unit == "any");
  CHECK(d.parameters[4].range.upper == 5.0);
  CHECK(d.parameters[5].binding.kind == Binding::Kind::parameter);
  CHECK(d.parameters[5].binding.parameter == 0);
  CHECK_FALSE(d.parameters[0].structural);
}

TEST_CASE("a block's parameter is a literal, a model parameter or a formula") {
  const Diagram d = diagram(arc);
  CHECK(parameter(d, "H", "initial").kind == Binding::Kind::literal);
  CHECK(parameter(d, "H", "initial").value == 0.05);
  CHECK(parameter(d, "H", "initial").at == Position{13, 42});
  CHECK(parameter(d, "gamma", "initial").value == 0.0);
  CHECK(parameter(d, "speed", "gain").kind == Binding::Kind::parameter);
  CHECK(parameter(d, "speed", "gain").parameter == d.find_parameter("V"));
  const Binding& turn = parameter(d, "turning", "gain");
  CHECK(turn.kind == Binding::Kind::formula);
  CHECK(turn.operands == std::vector<int>{d.find_parameter("V"), d.find_parameter("L")});
}

TEST_CASE("coefficients are parameters, literal zeros are absent") {
  const Diagram d = diagram(R"toml(flyball = 1
[parameters]
T = 2.0
[blocks]
c = { type = "Constant" }
filter = { type = "TransferFcn", numerator = [0, 3.0], denominator = ["T^2", 0.0, "1 + 1"] }
plant = { type = "StateSpace", A = [[0.0, 1.0], ["-T", -2.0]], B = [[0.0], [1.0]], C = [[1.0, 0.0]] }
[diagram]
wires = ["c -> filter, plant"]
)toml");
  CHECK(block(d, "filter").parameters.size() == 3);
  CHECK(parameter(d, "filter", "numerator[1]").value == 3.0);
  CHECK(parameter(d, "filter", "denominator[0]").kind == Binding::Kind::formula);
  CHECK(parameter(d, "filter", "denominator[2]").value == 2.0);
  CHECK(parameter(d, "plant", "A[0][1]").value == 1.0);
  CHECK(parameter(d, "plant", "A[1][0]").kind == Binding::Kind::formula);
  CHECK(parameter(d, "plant", "A[1][1]").value == -2.0);
}

TEST_CASE("blocks of equal type and structure share one object") {
  const Diagram d = diagram(R"toml(flyball = 1
[parameters]
Ts = "10 ms"
n = 2
[blocks]
c = { type = "Constant" }
g1 = { type = "Gain", gain = 2.0 }
g2 = { type = "Gain", gain = "Ts" }
plus = { type = "Sum", signs = "+-" }
minus = { type = "Sum", signs = "-+" }
also = { signs = "+-", type = "Sum" }
d1 = { type = "UnitDelay", sample_time = "Ts" }
d2 = { type = "UnitDelay", sample_time = 0.01, initial = 3.0 }
d3 = { type = "UnitDelay", sample_time = "20 ms" }
m1 = { type = "Mux", inputs = "n" }
m2 = { type = "Mux" , inputs = 2 }
t1 = { type = "TransferFcn", denominator = [2.0, 1.0] }
t2 = { type = "TransferFcn", denominator = ["Ts", 3.0] }
t3 = { type = "TransferFcn", denominator = [2.0, 0] }
[diagram]
wires = ["c -> g1, g2, plus.u1, plus.u2, minus.u1, minus.u2, also.u1, also.u2, d1, d2, d3, m1.u1, m1.u2",
         "c -> m2.u1, m2.u2, t1, t2, t3"]
)toml");
  const auto object = [&](std::string_view name) { return block(d, name).object; };
  CHECK(object("g1") == object("g2"));
  CHECK(object("plus") == object("also"));
  CHECK(object("plus") != object("minus"));
  CHECK(object("d1") == object("d2"));
  CHECK(object("d1") != object("d3"));
  CHECK(object("m1") == object("m2"));
  CHECK(object("t1") == object("t2"));
  CHECK(object("t1") != object("t3"));
  CHECK(d.parameters[d.find_parameter("Ts")].structural);
  CHECK(d.parameters[d.find_parameter("n")].structural);
  CHECK(parameter(d, "d3", "sample_time").value == 0.02);
  CHECK(parameter(d, "d2", "initial").value == 3.0);
}

TEST_CASE("structure computed from parameters makes all of them structural") {
  const Diagram d = diagram(R"toml(flyball = 1
[parameters]
rate = "100 Hz"
Ts = "1/rate"
K = 2.0
[blocks]
clock = { type = "Clock" }
hold = { type = "ZeroOrderHold", sample_time = "Ts/2" }
[diagram]
wires = ["clock -> hold"]
)toml");
  CHECK(d.parameters[d.find_parameter("rate")].structural);
  CHECK(d.parameters[d.find_parameter("Ts")].structural);
  CHECK_FALSE(d.parameters[d.find_parameter("K")].structural);
  CHECK(block(d, "hold").object->specification->period == Rational::fraction(1, 200));
}

TEST_CASE("the free names of a block's formula are parameters of the model") {
  const Diagram d = diagram(R"toml(flyball = 1
[parameters]
K = 2.0
[blocks]
c = { type = "Constant" }
f = { type = "Expression", formula = "K*u1 + max(u2, 3 m)", inputs = ["u1", "u2"] }
[diagram]
wires = ["c -> f.u1, f.u2"]
)toml");
  CHECK(parameter(d, "f", "K").kind == Binding::Kind::parameter);
  CHECK(parameter(d, "f", "K").parameter == d.find_parameter("K"));
}

TEST_CASE("wires chain, fan out and take elements") {
  const Diagram d = diagram(R"toml(flyball = 1
[blocks]
c = { type = "Constant" }
robot = { type = "DifferentialDrive" }
mux = { type = "Mux", inputs = 3 }
split = { type = "Demux", outputs = 3 }
sum = { type = "Sum", signs = "+++" }
[diagram]
wires = [
  "c -> robot.right, robot.left",
  "robot.pose.x -> mux.u1",
  "robot.pose.y->mux.u2,sum.u3",
  "  robot.pose.theta  ->  mux.u3  ",
  "mux -> split",
  "split.y2 -> sum.u1",
  "mux.y.3 -> sum.u2",
]
)toml");
  CHECK(source(d, "robot", "right") == "c.y");
  CHECK(source(d, "robot", "left") == "c.y");
  CHECK(source(d, "mux", "u1") == "robot.x");
  CHECK(source(d, "mux", "u3") == "robot.theta");
  CHECK(source(d, "split", "u.1") == "mux.y.1");
  CHECK(source(d, "split", "u.3") == "mux.y.3");
  CHECK(source(d, "sum", "u1") == "split.y2");
  CHECK(source(d, "sum", "u2") == "mux.y.3");
  CHECK(source(d, "sum", "u3") == "robot.y");
  // Without `log`: the outputs of the blocks that feed no other.
  CHECK(logged(d) == Names{"sum"});
}

TEST_CASE("logged signals expand to their elements") {
  const std::string model = R"toml(flyball = 1
[blocks]
c = { type = "Constant" }
robot = { type = "DifferentialDrive" }
[diagram]
wires = ["c -> robot.right, robot.left"]
)toml";
  CHECK(logged(diagram(model)) ==
        Names{"robot.v", "robot.omega", "robot.pose.x", "robot.pose.y", "robot.pose.theta"});
  const Diagram pose = diagram(model + "log = [\"robot.pose\", \"c\", \"robot.pose.x\", \"robot.v\"]");
  CHECK(logged(pose) == Names{"robot.pose.x", "robot.pose.y", "robot.pose.theta", "c", "robot.v"});
  CHECK(pose.logged[2].unit == "rad");
  CHECK(pose.logged[4].unit == "m/s");
  CHECK(diagram(model + "log = []").logged.empty());
  // A ring: each block feeds one, so all are logged.
  CHECK(logged(diagram(R"toml(flyball = 1
[blocks]
x = { type = "Integrator" }
k = { type = "Gain" }
[diagram]
wires = ["x -> k -> x"]
)toml")) == Names{"x", "k"});
}

TEST_CASE("overrides keep the dimension of what they replace") {
  const std::string_view text = R"toml(flyball = 1
[parameters]
J = "500 g*cm^2"
free = 2
[blocks]
c = { type = "Constant", value = "-12 V" }
)toml";
  const auto complaint = [&](const std::vector<Override>& overrides) {
    Diagnostics diagnostics("m.toml");
    read_diagram(text, diagnostics, overrides);
    const auto all = diagnostics.sorted();
    return all.empty() ? std::string() : all[0].message;
  };
  CHECK(complaint({{"J", "500 mm"}}) == "--set J: expected kg*m^2, found m");
  CHECK(complaint({{"J", "1"}, {"J", "500 mm"}}) == "--set J: expected kg*m^2, found m");
  CHECK(complaint({{"c.value", "5 m"}}) == "--set c.value: expected V, found m");
  CHECK(complaint({{"J", "600 g*cm^2"}, {"free", "3 m"}, {"c.value", "6 N*m/s/A"}}) == "");
  CHECK(complaint({{"J", "6e-5"}}) == "");
}

TEST_CASE("overrides replace parameters of the model and of blocks") {
  const Diagram d = diagram(arc, {{"V", "2*L/(1 s)"},
                                  {"K_gamma", "3"},
                                  {"H.initial", "20 mm"},
                                  {"gamma.initial", "0.5"},
                                  {"sine.function", "cos"}});
  CHECK(d.parameters[d.find_parameter("V")].binding.kind == Binding::Kind::formula);
  CHECK(d.parameters[d.find_parameter("V")].doc == "mean wheel speed");
  CHECK(d.find_parameter("L") < d.find_parameter("V"));
  CHECK(d.parameters[d.find_parameter("K_gamma")].binding.value == 3.0);
  CHECK(parameter(d, "H", "initial").value == 0.02);
  CHECK(parameter(d, "gamma", "initial").value == 0.5);
  CHECK(block(d, "sine").object != block(diagram(arc), "sine").object);

  const Diagram filter = diagram(R"toml(flyball = 1
[blocks]
c = { type = "Constant" }
filter = { type = "TransferFcn", denominator = [1.0, 2.0] }
mux = { type = "Mux", inputs = 1 }
[diagram]
wires = ["c -> filter", "c -> mux.u1, mux.u2"]
)toml",
                                 {{"filter.denominator[1]", "7"}, {"mux.inputs", "2"}});
  CHECK(parameter(filter, "filter", "denominator[1]").value == 7.0);
  CHECK(block(filter, "mux").inputs.size() == 2);
}
