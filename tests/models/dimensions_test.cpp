// What the units of a model come to.
#include "models/dimensions.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <regex>

#include "tests/catch.h"
#include "tests/source_dir.h"

namespace flyball {
namespace {

namespace fs = std::filesystem;

std::string listing(const std::vector<Diagnostic>& all) {
  std::string lines;
  for (const Diagnostic& diagnostic : all) lines += to_string(diagnostic) + '\n';
  return lines;
}

std::string said_about(const std::string& text, const std::vector<Override>& overrides = {},
                       const std::string& file = "m") {
  Diagnostics diagnostics(file);
  (void)read_diagram(text, diagnostics, overrides);
  return listing(diagnostics.sorted());
}

Diagram diagram_of(const std::string& text) {
  Diagnostics diagnostics("m");
  auto diagram = read_diagram(text, diagnostics);
  INFO(listing(diagnostics.sorted()));
  REQUIRE(diagram.has_value());
  return *std::move(diagram);
}

/// "x m/s, y -", and the notes.
std::string units_in(const std::string& text) {
  const DimensionTable table = dimension_table(diagram_of(text));
  std::string result;
  for (const auto* list : {&table.signals, &table.parameters}) {
    for (const NamedUnit& named : *list) {
      result += (result.empty() ? "" : ", ") + named.name + ' ' + (named.unit.empty() ? "-" : named.unit);
    }
  }
  for (const Diagnostic& note : table.notes) result += '\n' + note.message;
  return result;
}

std::string model(const std::string& parameters, const std::string& blocks, const std::string& wires) {
  return "flyball = 1\n[parameters]\n" + parameters + "\n[blocks]\n" + blocks + "\n[diagram]\nwires = [" +
         wires + "]\n";
}

std::vector<fs::path> shipped() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(source_dir() + "/models")) {
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

std::string content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

TEST_CASE("a unit goes on along wires, through products, rates and choices") {
  CHECK(units_in(model("V = \"2 m/s\"", R"toml(
speed = { type = "Constant", value = "V" }
way   = { type = "Integrator" }
half  = { type = "Gain", gain = 0.5 }
area  = { type = "Product" }
side  = { type = "Expression", inputs = ["A"], formula = "sqrt(A)" }
limit = { type = "Saturation" })toml",
                       R"("speed -> way -> area.u1, half", "way -> area.u2", "area -> side -> limit")")) ==
        "speed m/s, way m, half -, area m^2, side m, limit m, V m/s");
}

TEST_CASE("a value without unit takes the one that the others leave for it") {
  CHECK(units_in(model("K = 0.5\nH = \"1 m\"\nw = \"2 1/s\"", R"toml(
x    = { type = "Integrator", initial = "H" }
gain = { type = "Gain", gain = "K" }
rate = { type = "Gain", gain = "-w" }
sum  = { type = "Sum" })toml",
                       R"("x -> gain -> sum.u1", "x -> rate -> sum.u2", "sum -> x")")) ==
        "x m, gain m/s, rate m/s, sum m/s, K 1/s, H m, w 1/s");
}

TEST_CASE("a literal factor is a number, an added literal has the other's unit, and 0 has any") {
  const std::string source = "u = { type = \"Constant\", value = \"3 m\" }\n";
  const auto unit = [&](const std::string& formula) {
    const std::string all = units_in(
        model("T = \"2 s\"",
              source + "y = { type = \"Expression\", inputs = [\"u\"], formula = \"" + formula + "\" }",
              "\"u -> y\""));
    return all.substr(0, all.find(", T s"));
  };
  CHECK(unit("2*u") == "u m, y m");
  CHECK(unit("u + 2") == "u m, y m");
  CHECK(unit("max(u, 0)/T") == "u m, y m/s");
  CHECK(unit("if(u > 1, u, 0)") == "u m, y m");
  CHECK(unit("atan2(u, 1 m)") == "u m, y 1");
  CHECK(unit("u^(1/2)") == "u m, y m^(1/2)");
  CHECK(unit("u*5 1/s^2 + u/T^2") == "u m, y m/s^2");
  CHECK(unit("0") == "u m, y -");
}

TEST_CASE("a factor that hides a unit is noted where the model has no units") {
  CHECK(units_in(model("", R"toml(
loss = { type = "Sum", signs = "+-" }
one  = { type = "Constant" }
x    = { type = "Integrator" })toml",
                       R"("one -> loss.u1", "x -> loss.u2", "loss -> x")")) ==
        "loss -, one -, x -\nthe rate of x hides a factor in 1/s: it cannot be x/s");
  CHECK(units_in(model("", R"toml(
angle  = { type = "Integrator" }
speed  = { type = "Integrator" }
torque = { type = "Expression", inputs = ["a"], formula = "-9.81*sin(a)" })toml",
                       R"("angle -> torque -> speed -> angle")")) ==
        "angle 1, speed 1/s, torque 1/s^2\n"
        "-9.81 in torque hides a factor in 1/s^2: as a plain number it contradicts the other equations");
}

TEST_CASE("where neither a literal nor a rate is in the way, the demand of a block is left out") {
  const std::string text = model("", R"toml(
clock = { type = "Clock" }
wave  = { type = "Expression", formula = "sin(u)" })toml",
                                 R"("clock -> wave")");
  CHECK(said_about(text).empty());
  CHECK(units_in(text) ==
        "clock s, wave 1\na factor with a unit is hidden: wave wants a plain number as clock");
}

TEST_CASE("a hidden factor is noted by every check of a model with units") {
  CHECK(said_about(model("U = \"2 V\"", R"toml(
loss = { type = "Sum", signs = "+-" }
one  = { type = "Constant", value = "U" }
x    = { type = "Integrator" })toml",
                         R"("one -> loss.u1", "x -> loss.u2", "loss -> x")")) ==
        "m:8:1: note: the rate of x hides a factor in 1/s: it cannot be x/s\n");
}

TEST_CASE("logged signals get the unit that is found") {
  const Diagram diagram = diagram_of(model("V = \"2 m/s\"", R"toml(
speed = { type = "Constant", value = "V" }
way   = { type = "Integrator" }
half  = { type = "Gain", gain = 0.5 })toml",
                                           R"("speed -> way -> half"]
log = ["speed", "way", "half")"));
  REQUIRE(diagram.logged.size() == 3);
  CHECK(diagram.logged[0].unit == "m/s");
  CHECK(diagram.logged[1].unit == "m");
  CHECK(diagram.logged[2].unit == "any");
}

TEST_CASE("an override in a unit that the diagram does not take is refused, whatever it replaces") {
  const std::string text = content(source_dir() + "/models/line_arc/arc_error_loop.toml");
  CHECK(said_about(text, {{"K_gamma", "0.8"}}).empty());
  CHECK(said_about(text, {{"K_gamma", "0.8 rad"}}).empty());
  const std::string said = said_about(text, {{"K_gamma", "1 kg"}});
  CHECK(said.substr(0, said.find('\n')) == "m: error: --set K_gamma: expected a plain number, found kg");
  const std::string block = said_about(text, {{"gamma.initial", "1 m"}});
  CHECK(block.substr(0, block.find('\n')) ==
        "m: error: --set gamma.initial: expected a plain number, found m");
}

TEST_CASE("mistakes that are independent are all reported at once") {
  std::string text = content(source_dir() + "/models/classic/relay_thermostat.toml");
  text.replace(text.find("0.5 K"), 5, "0.5 W");
  text.replace(text.find("2 MJ/K"), 6, "2 MJ");
  const std::string said = said_about(text);
  CHECK_THAT(said, Catch::Contains("error: d is in W, but"));
  CHECK_THAT(said, Catch::Contains("error: C is in J, but"));
}

TEST_CASE("exponents that do not fit are left out of the check") {
  std::string formula = "x";
  for (int k = 0; k < 12; ++k) formula = "(" + formula + ")^99";
  CHECK(said_about(model("x = \"1 m\"", "c = { type = \"Constant\", value = \"" + formula + " + 1 s\" }", ""))
            .empty());
}

TEST_CASE("shipped models check, with no note but those that are meant") {
  for (const fs::path& path : shipped()) {
    INFO(path);
    CHECK(said_about(content(path), {}, path.string()).empty());
  }
}

TEST_CASE("shipped models without their units are not refused") {
  const std::regex with_unit("\"(-?[0-9.]+(e-?[0-9]+)?) [^\"]*\""), declared(", unit = \"[^\"]*\"");
  for (const fs::path& path : shipped()) {
    const std::string text = std::regex_replace(content(path), with_unit, "$1");
    INFO(path);
    CHECK(said_about(std::regex_replace(text, declared, ""), {}, path.string()).empty());
  }
}

TEST_CASE("random models without units are not refused") {
  // What stands behind each | is what the block takes.
  const std::vector<std::pair<std::string, int>> kinds{
      {"{ type = \"Gain\", gain = 2.0 }", 1},
      {"{ type = \"Gain\", gain = \"p\" }", 1},
      {"{ type = \"Gain\", gain = \"-2*p/q\" }", 1},
      {"{ type = \"Integrator\", initial = 1.0 }", 1},
      {"{ type = \"Integrator\", initial = \"q\" }", 1},
      {"{ type = \"TransferFcn\", denominator = [1.0, 2.0, \"p\"] }", 1},
      {"{ type = \"Saturation\", upper = \"q\" }", 1},
      {"{ type = \"UnitDelay\", sample_time = 0.1 }", 1},
      {"{ type = \"PID\", Kp = 1.0, Ki = \"p\", Kd = 3.0 }", 1},
      {"{ type = \"Sum\", signs = \"+-\" }", 2},
      {"{ type = \"Product\", signs = \"*/\" }", 2},
      {"{ type = \"Expression\", inputs = [\"u1\", \"u2\"], formula = \"9.81*sin(u1) + u2^2*p\" }", 2},
      {"{ type = \"Expression\", inputs = [\"u1\", \"u2\"], formula = \"if(u1 > q, sqrt(u2), 3)\" }", 2},
      {"{ type = \"Step\" }", 0},
      {"{ type = \"SineWave\", frequency = \"q\" }", 0}};
  std::mt19937 random(7);
  for (int k = 0; k < 200; ++k) {
    const int count = 2 + static_cast<int>(random() % 30);
    std::string blocks, wires;
    for (int b = 0; b < count; ++b) {
      const auto& [text, inputs] = kinds[random() % kinds.size()];
      blocks += "b" + std::to_string(b) + " = " + text + '\n';
      for (int u = 1; u <= inputs; ++u) {
        const std::string port = inputs == 1 ? "" : ".u" + std::to_string(u);
        wires += "\"b" + std::to_string(random() % static_cast<unsigned>(count)) + " -> b" +
                 std::to_string(b) + port + "\", ";
      }
    }
    const std::string text = model("p = 2.0\nq = \"3*p\"", blocks, wires);
    INFO(text);
    CHECK(said_about(text).empty());
    CHECK_FALSE(dimension_table(diagram_of(text)).signals.empty());
  }
}

}  // namespace flyball
