// One unit of a working model is written wrong; the message names it first, or second behind a unit that
// would settle the diagram as well.
#include <algorithm>
#include <fstream>
#include <iterator>

#include "models/diagram.h"
#include "tests/catch.h"
#include "tests/source_dir.h"

namespace flyball {
namespace {

struct Mistake {
  std::string model;  // a file, or the key of a text below
  std::string right, wrong;
  std::string culprit;
};

std::string content(const std::string& name) {
  std::ifstream file(source_dir() + "/models/" + name, std::ios::binary);
  REQUIRE(file.is_open());
  return {std::istreambuf_iterator<char>(file), {}};
}

// The distance of a cart is delayed and summed without a unit, and becomes a force behind that.
const char* const delayed_spring = R"toml(flyball = 1
[parameters]
mass = "2 kg"
wind = "1 N"
[blocks]
cart      = { type = "Integrator", initial = "1 m" }
speed     = { type = "Integrator" }
delay     = { type = "UnitDelay", sample_time = "1 ms" }
limit     = { type = "Saturation", lower = -1.0, upper = 1.0 }
stiffness = { type = "Gain", gain = "5 N/m" }
gust      = { type = "Constant", value = "wind" }
force     = { type = "Sum", signs = "+-" }
inverse   = { type = "Gain", gain = "1/mass" }
[diagram]
wires = [
  "cart -> delay -> limit -> stiffness -> force.u2",
  "gust -> force.u1",
  "force -> inverse -> speed -> cart",
]
)toml";

// x'' = -omega^2 x
const char* const oscillator = R"toml(flyball = 1
[parameters]
omega = "3 1/s"
[blocks]
spring   = { type = "Gain", gain = "-omega^2" }
velocity = { type = "Integrator" }
x        = { type = "Integrator", initial = "10 mm" }
[diagram]
wires = ["x -> spring -> velocity -> x"]
)toml";

// A robot on its way to a heading.
const char* const turning = R"toml(flyball = 1
[parameters]
heading = "90 deg"
base    = "60 deg/s"
gain    = "2 1/s"
[blocks]
robot  = { type = "DifferentialDrive", wheel_diameter = "40 mm", track_width = "54 mm" }
wanted = { type = "Constant", value = "heading" }
error  = { type = "Sum", signs = "+-" }
turn   = { type = "Gain", gain = "gain" }
drive  = { type = "Constant", value = "base" }
right  = { type = "Sum", signs = "++" }
left   = { type = "Sum", signs = "+-" }
[diagram]
wires = [
  "wanted -> error.u1",
  "robot.pose.theta -> error.u2",
  "error -> turn -> right.u2, left.u2",
  "drive -> right.u1, left.u1",
  "right -> robot.right",
  "left -> robot.left",
]
)toml";

// C v' = i - v/R, with a current that a controller sets
const char* const capacitor = R"toml(flyball = 1
[parameters]
C = "10 uF"
R = "1 kohm"
K = "5 mA/V"
[blocks]
wanted     = { type = "Constant", value = "3 V" }
error      = { type = "Sum", signs = "+-" }
controller = { type = "Gain", gain = "K" }
current    = { type = "Expression", inputs = ["i", "v"], formula = "i - v/R" }
charge     = { type = "Gain", gain = "1/C" }
v          = { type = "Integrator" }
[diagram]
wires = [
  "wanted -> error.u1",
  "v -> error.u2, current.v",
  "error -> controller -> current.i",
  "current -> charge -> v",
]
)toml";

std::string text_of(const std::string& model) {
  if (model == "delayed_spring") return delayed_spring;
  if (model == "oscillator") return oscillator;
  if (model == "turning") return turning;
  if (model == "capacitor") return capacitor;
  return content(model);
}

const std::vector<Mistake>& mistakes() {
  static const std::string servo = "classic/pid_servo.toml", cascade = "classic/two_rate_loop.toml",
                           sampled = "classic/sampled_dc_motor.toml", room = "classic/relay_thermostat.toml",
                           arc = "line_arc/arc_error_loop.toml";
  static const std::vector<Mistake> all{
      {servo, "1 rev", "1 rev/s", "angle"},
      {servo, "e-6 kg*m^2", "e-6 kg*m", "J"},
      {servo, "3.5077e-6 N*m*s", "3.5077e-6 N*m", "b"},
      {servo, "0.0274 N*m/A", "0.0274 N*m", "K"},
      {servo, "4 ohm", "4 A/V", "R"},
      {servo, "21 V", "21 A", "Kp"},
      {servo, "500 V/s", "500 V", "Ki"},
      {servo, "0.15 V*s", "0.15 V", "Kd"},
      {servo, "\"12 V", "\"12 A", "U"},
      {servo, "5 mN*m", "5 mN", "T"},
      {cascade, "2 ohm", "2 V", "R"},
      {cascade, "1 mH", "1 mF", "L"},
      {cascade, "0.05 N*m/A", "0.05 N*m*s", "K"},
      {cascade, "5e-5 kg*m^2", "5e-5 kg*m", "J"},
      {cascade, "1e-5 N*m*s", "1e-5 N*m", "b"},
      {cascade, "\"100 rad/s", "\"100 rad", "w_wanted.value"},
      {cascade, "0.1 A*s", "0.1 A", "w_control.Kp"},
      {cascade, "4000 V/(A*s)", "4000 V/A", "i_control.Ki"},
      {cascade, "-5 A", "-5 V", "w_control.lower"},
      {cascade, "0.1 N*m\"", "0.1 N\"", "load.after"},
      {sampled, "0.1 mV*s^2", "0.1 mV*s", "controller.Kd"},
      {sampled, "10 V", "10 V/s", "controller.Ki"},
      {sampled, "-24 V", "-24 A", "controller.lower"},
      {room, "2 MJ/K", "2 MJ", "C"},
      {room, "100 W/K", "100 W", "G"},
      {room, "0.5 K", "0.5 W", "d"},
      {room, "4 kW", "4 kJ", "P"},
      {arc, "1/m", "1/s", "K_H"},
      {arc, "300 mm", "300 mm^2", "L"},
      {arc, "500 mm/s", "500 mm", "V"},
      {arc, "50 mm", "50 mm^2", "H.initial"},
      {"delayed_spring", "5 N/m", "5 N", "stiffness.gain"},
      {"delayed_spring", "1 N\"", "1 J\"", "wind"},
      {"delayed_spring", "2 kg", "2 g*m", "mass"},
      {"oscillator", "3 1/s", "3 1/m", "omega"},
      {"turning", "60 deg/s", "60 deg", "base"},
      {"turning", "90 deg", "90 deg/s", "heading"},
      {"turning", "2 1/s", "2 s", "gain"},
      {"capacitor", "10 uF", "10 uH", "C"},
      {"capacitor", "1 kohm", "1 kA/V", "R"},
      {"capacitor", "5 mA/V", "5 mA", "K"},
  };
  return all;
}

/// Those whom the messages accuse, the likeliest first.
std::vector<std::string> accused(const std::vector<Diagnostic>& said) {
  std::vector<std::string> names;
  for (const Diagnostic& d : said) {
    const bool accuses = d.severity == Diagnostic::Severity::error ||
                         d.message.find(" would settle ") != std::string::npos ||
                         d.message.find(" would have to be ") != std::string::npos;
    if (accuses) names.push_back(d.message.substr(0, d.message.find(' ')));
  }
  return names;
}

std::vector<Diagnostic> said_about(const std::string& text) {
  Diagnostics diagnostics("m");
  (void)read_diagram(text, diagnostics);
  return diagnostics.sorted();
}

}  // namespace

TEST_CASE("a unit that is written wrong is found, first or second") {
  int first = 0;
  for (const Mistake& mistake : mistakes()) {
    std::string text = text_of(mistake.model);
    CHECK(said_about(text).empty());
    const std::size_t at = text.find(mistake.right);
    REQUIRE(at != std::string::npos);
    text.replace(at, mistake.right.size(), mistake.wrong);
    const auto said = said_about(text);
    std::string listing;
    for (const Diagnostic& d : said) listing += to_string(d) + '\n';
    INFO(mistake.model << ": " << mistake.right << " as " << mistake.wrong << "\n" << listing);
    const auto names = accused(said);
    const auto place = std::ranges::find(names, mistake.culprit) - names.begin();
    CHECK(place < 2);
    CHECK(names.size() > static_cast<std::size_t>(place));
    first += place == 0 ? 1 : 0;
  }
  // The others have a rival that would settle the diagram as well, with a unit that is no odder.
  CHECK(first >= 37);
}

}  // namespace flyball
