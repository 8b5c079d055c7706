// A hierarchy is a way to write a diagram: it has the numbers of the same diagram written flat.
#include <cmath>

#include "tests/source_dir.h"
#include "tests/systems/harness.h"

using namespace flyball;
using namespace flyball::test;

namespace {

/// models/classic/cascade_servo.toml without subsystems, written by hand.
constexpr std::string_view flat_servo = R"toml(flyball = 1
[parameters]
angle = "1 rad"
Kv = "20 1/s"
Kp = "0.2 V*s"
tau = "40 ms"
R = "2 ohm"
L = "1 mH"
K = "0.05 N*m/A"
J = "5e-5 kg*m^2"
b = "1e-5 N*m*s"
[blocks]
wanted = { type = "Step", time = "10 ms", before = "0 rad", after = "angle" }
load = { type = "Step", time = "0.5 s", before = "0 N*m", after = "0.02 N*m" }
error = { type = "Sum", signs = "+-" }
position = { type = "Gain", gain = "Kv" }
speed_error = { type = "Sum", signs = "+-" }
controller = { type = "PID", Kp = "Kp", Ki = "Kp/tau", lower = "-24 V", upper = "24 V" }
across = { type = "Sum", signs = "+-" }
winding_net = { type = "Sum", signs = "+-" }
drop = { type = "Gain", gain = "R" }
rate = { type = "Gain", gain = "1/L" }
current = { type = "Integrator" }
torque = { type = "Gain", gain = "K" }
shaft_net = { type = "Sum", signs = "+--" }
friction = { type = "Gain", gain = "b" }
inertia = { type = "Gain", gain = "1/J" }
speed = { type = "Integrator" }
shaft = { type = "Integrator" }
back_emf = { type = "Gain", gain = "K" }
[diagram]
wires = [
  "wanted -> error.u1",
  "error -> position -> speed_error.u1",
  "shaft -> error.u2",
  "speed -> speed_error.u2",
  "speed_error -> controller -> across.u1",
  "across -> winding_net.u1",
  "winding_net -> rate -> current -> drop -> winding_net.u2",
  "current -> torque -> shaft_net.u1",
  "load -> shaft_net.u3",
  "shaft_net -> inertia -> speed -> friction -> shaft_net.u2",
  "speed -> shaft",
  "speed -> back_emf -> across.u2",
]
log = ["wanted", "shaft", "speed", "controller", "current"]
[simulation]
stop = "1 s"
log_interval = "1 ms"
)toml";

const std::vector<std::pair<std::string, std::string>> columns = {{"wanted", "wanted"},
                                                                  {"drive.angle", "shaft"},
                                                                  {"drive.speed", "speed"},
                                                                  {"drive.voltage", "controller"},
                                                                  {"drive.motor.current", "current"}};

std::string servo_file() { return source_dir() + "/models/classic/cascade_servo.toml"; }

}  // namespace

TEST_CASE("Hierarchy: the cascade servo gives the bytes of its flat twin, with every method") {
  for (const std::string method : {"dp5", "rk4", "adams", "bdf"}) {
    INFO(method);
    Model model = load_model(servo_file()), twin = read_model(flat_servo);
    model.settings.method = twin.settings.method = method;
    Run hierarchical(model), flat(twin);
    hierarchical.finish();
    flat.finish();
    CHECK(hierarchical.times() == flat.times());
    for (const auto& [name, flat_name] : columns) {
      INFO(name);
      CHECK(hierarchical.column(name) == flat.column(flat_name));
    }
  }
}

TEST_CASE("Hierarchy: a parameter of a part is set by its path, before and without a new plan") {
  const auto speed_without_load = [](double R) { return 0.05 * 12.0 / (0.05 * 0.05 + R * 1e-5); };
  const std::string motor = source_dir() + "/models/library/dc_motor.toml";
  // From time 0.5 s = 12 mechanical time constants on, exp(-12) = 6e-6 is left of the way; with 4 ohm the
  // constant is twice as long, and exp(-6) = 2.5e-3 is left.
  Run rated(load_model(motor));
  rated.finish();
  CHECK(std::fabs(rated.logged("speed", 0.5) / speed_without_load(2.0) - 1.0) < 1e-5);
  Run warm(load_model(motor, {{"R", "4 ohm"}}));
  warm.finish();
  CHECK(std::fabs(warm.logged("speed", 0.5) / speed_without_load(4.0) - 1.0) < 3e-3);

  // The path of the same parameter in a model that uses the file.
  Run set(load_model(servo_file(), {{"drive.motor.R", "4 ohm"}})), swept(load_model(servo_file()));
  swept.simulator().set_parameter("drive.motor.R", 4.0);
  set.finish();
  swept.finish();
  CHECK(set.column("drive.motor.current") == swept.column("drive.motor.current"));
  CHECK(set.column("drive.motor.current") !=
        Run(load_model(servo_file())).finish().column("drive.motor.current"));
}
