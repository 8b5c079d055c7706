// Subsystems become blocks of a flat diagram: names, parameters, wires through ports, overrides, files.
#include <algorithm>
#include <fstream>
#include <set>

#include "models/plan.h"
#include "tests/catch.h"
#include "tests/studies/temporary_folder.h"

using namespace flyball;
using flyball::test::TemporaryFolder;

namespace {

using Names = std::vector<std::string>;

Diagram diagram(std::string_view text, const std::vector<Override>& overrides = {},
                const std::string& file = "model.toml") {
  Diagnostics diagnostics(file);
  auto result = read_diagram(text, diagnostics, overrides);
  for (const Diagnostic& diagnostic : diagnostics.sorted()) UNSCOPED_INFO(to_string(diagnostic));
  REQUIRE(result.has_value());
  return *std::move(result);
}

std::string refusal(std::string_view text, const std::vector<Override>& overrides = {}) {
  Diagnostics diagnostics("model.toml");
  CHECK_FALSE(read_diagram(text, diagnostics, overrides).has_value());
  std::string lines;
  for (const Diagnostic& diagnostic : diagnostics.sorted()) lines += to_string(diagnostic) + "\n";
  return lines;
}

std::shared_ptr<const Plan> plan(Diagram flat) {
  Diagnostics diagnostics("model.toml");
  auto result = make_plan(std::make_shared<const Diagram>(std::move(flat)), diagnostics);
  for (const Diagnostic& diagnostic : diagnostics.sorted()) UNSCOPED_INFO(to_string(diagnostic));
  REQUIRE(result != nullptr);
  return result;
}

Names names(const Diagram& flat) {
  Names result;
  for (const Instance& instance : flat.instances) result.push_back(instance.name);
  return result;
}

Names logged(const Diagram& flat) {
  Names result;
  for (const Logged& signal : flat.logged) result.push_back(signal.name);
  return result;
}

/// "block.slot"
std::string name_of(const Diagram& flat, Endpoint end) {
  const Instance& from = flat.instances.at(end.instance);
  return from.name + "." + from.object->specification->slots[end.slot].name;
}

std::string source(const Diagram& flat, std::string_view of, std::string_view input) {
  const Instance& instance = flat.instances.at(flat.find_instance(of));
  for (const auto& [slot, end] : instance.inputs) {
    if (instance.object->specification->slots[slot].name == input) return name_of(flat, end);
  }
  return "no such input";
}

/// The number that a parameter starts with, found as a sweep finds it.
double value(const Plan& plan, std::string_view name) {
  const int slot = plan.parameter_slot(name);
  for (const Start& literal : plan.literals) {
    if (literal.slot == slot) return literal.value;
  }
  FAIL("no literal of this name");
  throw;
}

const std::string two_lags = R"toml(flyball = 1
[parameters]
tau = "2 s"
[subsystems.Lag]
ports = { inputs = { u = "any" }, outputs = { y = "any" } }
parameters = { T = "1 s", k = 1.0 }
blocks = { error = { type = "Sum", signs = "+-" }, rate = { type = "Gain", gain = "k/T" }, x = { type = "Integrator" } }
diagram.wires = ["u -> error.u1", "error -> rate -> x -> error.u2", "x -> y"]
[blocks]
step   = { type = "Step" }
first  = { type = "Lag", T = "tau" }
second = { type = "Lag", k = 3.0 }
[diagram]
wires = ["step -> first -> second"]
)toml";

}  // namespace

TEST_CASE("a subsystem is unfolded where it stands, and its ports are gone") {
  const Diagram d = diagram(two_lags);
  CHECK(names(d) ==
        Names{"step", "first.error", "first.rate", "first.x", "second.error", "second.rate", "second.x"});
  CHECK(source(d, "first.error", "u1") == "step.y");
  CHECK(source(d, "second.error", "u1") == "first.x.x");
  // The only output of a subsystem goes by its name, as that of a block does.
  CHECK(logged(d) == Names{"second"});
  CHECK(name_of(d, d.logged[0].source) == "second.x.x");
  // Equal parts share one object, whatever subsystem they are in.
  CHECK(d.instances[d.find_instance("first.x")].object == d.instances[d.find_instance("second.x")].object);
}

TEST_CASE("parameters of subsystems stay parameters, by their paths") {
  const auto p = plan(diagram(two_lags));
  // A name alone is the same slot: what changes tau changes first.T.
  CHECK(p->parameter_slot("first.T") == p->parameter_slot("tau"));
  CHECK(value(*p, "second.T") == 1.0);
  CHECK(value(*p, "first.k") == 1.0);
  CHECK(value(*p, "second.k") == 3.0);
  CHECK(p->parameter_slot("second.rate.gain") > 0);
  CHECK(p->slot_name(p->parameter_slot("second.rate.gain")) == "second.rate.gain");
  CHECK(p->slot_name(p->parameter_slot("second.k")) == "second.k");
  CHECK(p->parameter_slot("third.k") == -1);
  CHECK(p->parameter_slot("second.q") == -1);
  CHECK(p->diagram->parameters[p->diagram->find_parameter("second.T")].unit == "s");
}

TEST_CASE("overrides reach into one use of a subsystem") {
  const auto p =
      plan(diagram(two_lags, {{"first.k", "5"}, {"second.rate.gain", "7 1/s"}, {"second.T", "300 ms"}}));
  CHECK(value(*p, "first.k") == 5.0);
  CHECK(value(*p, "second.k") == 3.0);
  CHECK(value(*p, "second.rate.gain") == 7.0);
  CHECK(value(*p, "second.T") == 0.3);
  CHECK(refusal(two_lags, {{"first.rat.gain", "5"}}) ==
        "model.toml: error: --set first.rat.gain: there is no block \"rat\"; did you mean \"rate\"?\n");
  CHECK(refusal(two_lags, {{"step.rate.gain", "5"}}) ==
        "model.toml: error: --set step.rate.gain: \"step\" is a block without parts\n");
  CHECK(refusal(two_lags, {{"first.T", "5 m"}}) == "model.toml: error: --set first.T: expected s, found m\n");
  CHECK(refusal(two_lags, {{"first.q", "5"}}) ==
        "model.toml: error: --set first.q: Lag has no parameter \"q\"; known: T, k\n"
        "model.toml:4:13: note: \"Lag\" is declared here\n");
  CHECK(refusal(two_lags, {{"first.type", "Gain"}}) ==
        "model.toml: error: --set first.type: the type of a subsystem cannot be set\n");
}

TEST_CASE("a definition inside another one sees the parameters of the use that it is part of") {
  const auto p = plan(diagram(R"toml(flyball = 1
[parameters]
a = 1.0
b = 2.0
[subsystems.Outer]
ports.outputs.y = "any"
parameters.b = 3.0
subsystems.Inner = { ports = { outputs = { y = "any" } }, parameters = { c = 4.0 }, blocks = { k = { type = "Constant", value = "a" }, l = { type = "Constant", value = "b" }, m = { type = "Constant", value = "c" } }, diagram = { wires = ["k -> y"] } }
blocks.inner = { type = "Inner", c = "b + a" }
diagram.wires = ["inner -> y"]
[blocks]
one = { type = "Outer" }
two = { type = "Outer", b = 30.0 }
)toml"));
  CHECK(p->parameter_slot("one.inner.k.value") == p->parameter_slot("a"));
  CHECK(p->parameter_slot("one.inner.l.value") == p->parameter_slot("one.b"));
  CHECK(p->parameter_slot("two.inner.l.value") == p->parameter_slot("two.b"));
  CHECK(p->parameter_slot("two.inner.m.value") == p->parameter_slot("two.inner.c"));
  const Diagram& d = *p->diagram;
  const Binding& c = d.parameters[d.find_parameter("two.inner.c")].binding;
  REQUIRE(c.kind == Binding::Kind::formula);
  CHECK(d.parameters[c.operands[0]].name == "two.b");
  CHECK(d.parameters[c.operands[1]].name == "a");
}

TEST_CASE("a formula is read with the names of its own subsystem") {
  // 12 V is a voltage where nothing else is called V, and an error where something is.
  const std::string model = R"toml(flyball = 1
[subsystems.Plain]
ports = { inputs = { u = "V" }, outputs = { y = "V" } }
blocks.f = { type = "Expression", formula = "u + 2 V" }
diagram.wires = ["u -> f -> y"]
[subsystems.Other]
ports = { inputs = { u = "V" }, outputs = { y = "V" } }
parameters.V = 1.0
blocks.f = { type = "Expression", formula = "u + 2 V" }
diagram.wires = ["u -> f -> y"]
[blocks]
c = { type = "Constant" }
a = { type = "Plain" }
b = { type = "Other" }
[diagram]
wires = ["c -> a -> b"]
)toml";
  CHECK(refusal(model) ==
        "model.toml:9:52: error: \"V\" is a parameter here, not a unit: write 2*V, or give the parameter "
        "another "
        "name\n"
        "model.toml:14:14: note: used here, as \"b\"\n");
}

TEST_CASE("ports carry vectors, pass values through, and stand for a default when nothing is connected") {
  const Diagram d = diagram(R"toml(flyball = 1
[subsystems.Frame]
ports.inputs.speed = { unit = "rad/s", elements = ["right", "left"], default = "3 rad/s" }
ports.inputs.gain = { default = "g" }
ports.inputs.unread = { default = 0.0 }
ports.outputs.pose = { unit = ["m", "m", "rad"], elements = ["x", "y", "theta"] }
ports.outputs.echo = { unit = "rad/s", elements = ["right", "left"] }
ports.outputs.gain_used = {}
parameters.g = 2.0
blocks.drive = { type = "DifferentialDrive" }
diagram.wires = ["speed.right -> drive.right", "speed.left -> drive.left", "drive.pose -> pose", "speed -> echo", "gain -> gain_used"]
[blocks]
wheel = { type = "Constant" }
robot = { type = "Frame" }
turns = { type = "Gain", gain = "1 s" }
sum   = { type = "Sum", signs = "+++" }
[diagram]
wires = ["wheel -> robot.speed.right", "robot.pose.theta -> sum.u1", "robot.echo.left -> turns -> sum.u2", "robot.gain_used -> sum.u3"]
log = ["robot.pose", "robot.drive.v", "robot.echo.right", "sum"]
)toml");
  CHECK(names(d) == Names{"wheel", "robot.speed.left", "robot.gain", "robot.drive", "turns", "sum"});
  CHECK(source(d, "robot.drive", "right") == "wheel.y");
  CHECK(source(d, "robot.drive", "left") == "robot.speed.left.y");
  CHECK(source(d, "turns", "u") == "robot.speed.left.y");
  CHECK(source(d, "sum", "u3") == "robot.gain.y");
  CHECK(logged(d) == Names{"robot.pose.x", "robot.pose.y", "robot.pose.theta", "robot.drive.v",
                           "robot.echo.right", "sum"});
  CHECK(name_of(d, d.logged[4].source) == "wheel.y");
}

TEST_CASE("loops through subsystems are judged port by port") {
  // The two ways through the subsystem share no block: what goes in by a does not come out at y.
  plan(diagram(R"toml(flyball = 1
[subsystems.Pair]
ports = { inputs = { a = "any", b = "any" }, outputs = { x = "any", y = "any" } }
blocks = { p = { type = "Gain" }, q = { type = "Gain" } }
diagram.wires = ["a -> p -> x", "b -> q -> y"]
[blocks]
c = { type = "Constant" }
pair = { type = "Pair" }
[diagram]
wires = ["c -> pair.a", "pair.x -> pair.b"]
)toml"));
  CHECK(refusal(R"toml(flyball = 1
[subsystems.Wire]
ports = { inputs = { a = "any" }, outputs = { x = "any" } }
diagram.wires = ["a -> x"]
[blocks]
one = { type = "Wire" }
two = { type = "Wire" }
g = { type = "Gain" }
[diagram]
wires = ["one -> two -> one", "two -> g"]
)toml") == "model.toml:7:1: error: two.a only passes its own value on, so nothing gives it one\n");
}

TEST_CASE("a thousand uses cost one reading, and share their blocks' objects") {
  std::string text = R"toml(flyball = 1
[subsystems.Lag]
ports = { inputs = { u = "any" }, outputs = { y = "any" } }
blocks = { g = { type = "Gain" }, x = { type = "TransferFcn" } }
diagram.wires = ["u -> g -> x -> y"]
[diagram]
wires = ["source -> s0"]
[blocks]
source = { type = "Constant" }
)toml";
  std::string wires;
  for (int k = 0; k < 1000; ++k) text += "s" + std::to_string(k) + " = { type = \"Lag\" }\n";
  const auto at = text.find("\"source -> s0\"");
  for (int k = 0; k + 1 < 1000; ++k)
    wires += "\"s" + std::to_string(k) + " -> s" + std::to_string(k + 1) + "\", ";
  const Diagram d = diagram(text.insert(at, wires));
  CHECK(d.instances.size() == 2001);
  std::set<const BlockObject*> objects;
  for (const Instance& instance : d.instances) objects.insert(instance.object.get());
  CHECK(objects.size() == 3);
}

TEST_CASE("what is wrong with a definition is said once, whatever the number of its uses") {
  std::string text = R"toml(flyball = 1
[subsystems.Lag]
ports = { inputs = { u = "any" }, outputs = { y = "any" } }
blocks = { g = { type = "Gian" }, x = { type = "Integrator", initial = "1/0" } }
diagram.wires = ["u -> x", "x -> z"]
[blocks]
)toml";
  for (int k = 0; k < 100; ++k) text += "s" + std::to_string(k) + " = { type = \"Lag\" }\n";
  const std::string said = refusal(text);
  CHECK_THAT(said,
             Catch::Contains("model.toml:4:26: error: unknown block type \"Gian\"; did you mean \"Gain\"?\n"
                             "model.toml:7:15: note: used here, as \"s0\"\n"));
  CHECK_THAT(said, Catch::Contains("error: output y is not connected inside\n"));
  CHECK(std::ranges::count(said, '\n') < 120);
}

TEST_CASE("ten thousand levels are refused in words, and so is what unfolds without end") {
  std::string deep = "flyball = 1\n";
  for (int k = 0; k < 10'000; ++k) {
    deep += "[subsystems.S" + std::to_string(k) + "]\nblocks.b = { type = " +
            (k + 1 < 10'000 ? "\"S" + std::to_string(k + 1) + "\"" : std::string("\"Constant\"")) + " }\n";
  }
  CHECK_THAT(refusal(deep + "[blocks]\nb = { type = \"S0\" }\n"),
             Catch::Contains("error: subsystems are nested more than 100 levels deep"));
  // 50 levels, each twice the one before it.
  std::string wide = "flyball = 1\n";
  for (int k = 0; k < 50; ++k) {
    const std::string next = k == 0 ? "Constant" : "S" + std::to_string(k - 1);
    wide += "[subsystems.S" + std::to_string(k) + "]\nblocks.a = { type = \"" + next +
            "\" }\nblocks.b = { type = \"" + next + "\" }\n";
  }
  CHECK_THAT(refusal(wide + "[blocks]\nb = { type = \"S49\" }\n"),
             Catch::Contains("error: this takes the model beyond 1000000 blocks"));
}

TEST_CASE("files are found from the file that names them, and read once") {
  const TemporaryFolder folder;
  const auto write = [&](const std::string& name, const std::string& text) {
    std::filesystem::create_directories((folder / name).parent_path());
    std::ofstream(folder / name) << text;
  };
  write("library/gain.toml", R"toml(flyball = 1
[ports]
inputs.u  = { default = 1.0 }
outputs.y = {}
[parameters]
k = { value = 2.0, range = [0, 10] }
[blocks]
g = { type = "Gain", gain = "k" }
[diagram]
wires = ["u -> g -> y"]
log = ["nothing of this name"]
[simulation]
stop = "no time"
)toml");
  write("library/square.toml", R"toml(flyball = 1
[ports]
inputs.u  = {}
outputs.y = {}
[blocks]
a = { type = "gain.toml" }
b = { type = "./gain.toml", k = 3.0 }
[diagram]
wires = ["u -> a -> b -> y"]
)toml");
  const std::string text = R"toml(flyball = 1
[parameters]
k = 5.0
[blocks]
c = { type = "Constant" }
s = { type = "library/square.toml" }
g = { type = "library/../library/gain.toml", k = "2*k" }
[diagram]
wires = ["c -> s -> g"]
)toml";
  const std::string model = (folder / "model.toml").string();
  const Diagram d = diagram(text, {{"s.b.k", "4"}}, model);
  CHECK(names(d) == Names{"c", "s.a.g", "s.b.g", "g.g"});
  REQUIRE(d.used_files.size() == 2);
  CHECK(d.used_files[0].name == (folder / "library/square.toml").string());
  CHECK(d.used_files[1].name == (folder / "library/gain.toml").string());
  const auto p = plan(d);
  CHECK(value(*p, "s.a.k") == 2.0);
  CHECK(value(*p, "s.b.k") == 4.0);
  // A file with ports runs alone where its inputs have defaults; its outputs are then the log.
  std::string alone = d.used_files[1].text;
  alone = alone.substr(0, alone.find("log"));
  CHECK(logged(diagram(alone)) == Names{"y"});
  CHECK(names(diagram(alone)) == Names{"u", "g"});
}
