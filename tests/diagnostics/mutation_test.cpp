// Whatever happens to a model's text, reading it gives a diagram or an error with a position, and never
// crashes.
#include <random>

#include "models/diagram.h"
#include "tests/catch.h"

using namespace flyball;

namespace {

const std::string valid = R"toml(flyball = 1
[model]
title = "A loop of many parts"
[parameters]
V = { value = "500 mm/s", doc = "speed", range = [0.0, 2.0] }
L = { value = 0.3, unit = "m" }
turn = "if(V > 0.2 m/s, -2*V/L, min(V/L, 1 1/s))"
Ts = "1/3 s"
[blocks]
step = { type = "Step", time = "10 ms", after = "V/L" }
error = { type = "Sum", signs = "+-" }
control = { type = "PID", Kp = "2*turn", Ki = 0.5, setpoint_weights = false }
plant = { type = "TransferFcn", numerator = [1.0], denominator = ["L", 0, 1.0] }
drive = { type = "DifferentialDrive" }
split = { type = "Mux", inputs = 3 }
square = { type = "Expression", formula = "u1^2 + abs(u2)*L^3/V", inputs = ["u1", "u2"] }
held = { type = "ZeroOrderHold", sample_time = "Ts" }
[diagram]
wires = [
  "step -> error.u1",
  "error -> control -> plant -> error.u2",
  "plant -> drive.right, drive.left, held",
  "drive.pose.x -> split.u1",
  "drive.pose.y -> split.u2, square.u1",
  "held -> split.u3, square.u2",
]
log = ["plant", "drive.pose", "split.y.3"]
[simulation]
stop = "10 s"
solver = { method = "dp5", rtol = 1e-8, max_step = "0.1 s" }
log_interval = "1/60 s"
)toml";

class Mutator {
 public:
  explicit Mutator(unsigned seed) : random_(seed) {}

  std::string mutate(std::string text) {
    switch (below(6)) {
      case 0:
        return edit_lines(text, [&](auto& lines) { lines.erase(lines.begin() + below(lines.size())); });
      case 1:
        return edit_lines(text, [&](auto& lines) {
          const std::string line = lines[below(lines.size())];
          lines.insert(lines.begin() + below(lines.size()), line);
        });
      case 2:
        return edit_lines(
            text, [&](auto& lines) { std::swap(lines[below(lines.size())], lines[below(lines.size())]); });
      case 3:
        text[below(text.size())] = static_cast<char>(below(256));
        return text;
      case 4:
        text[below(text.size())] = "\"'[]{}=.,()->+*/^#\n0eE "[below(24)];
        return text;
      default:
        return text.substr(0, below(text.size()));
    }
  }

 private:
  int below(std::size_t n) { return static_cast<int>(random_() % n); }

  template <class Edit>
  static std::string edit_lines(const std::string& text, Edit edit) {
    std::vector<std::string> lines;
    std::size_t start = 0;
    for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n', start)) {
      lines.push_back(text.substr(start, end + 1 - start));
      start = end + 1;
    }
    if (!lines.empty()) edit(lines);
    std::string result;
    for (const std::string& line : lines) result += line;
    return result;
  }

  std::mt19937 random_;
};

}  // namespace

TEST_CASE("the text that is mutated is a valid model") {
  Diagnostics diagnostics("m");
  const auto diagram = read_diagram(valid, diagnostics);
  for (const Diagnostic& diagnostic : diagnostics.sorted()) UNSCOPED_INFO(to_string(diagnostic));
  REQUIRE(diagram.has_value());
  CHECK(diagram->logged.size() == 5);
}

TEST_CASE("mutations of a model give a diagram or positioned errors") {
  int refused = 0;
  for (unsigned seed = 0; seed < 2000; ++seed) {
    Mutator mutator(seed);
    std::string text = mutator.mutate(valid);
    // Every other text gets a second mutation, so that mistakes meet.
    if (seed % 2 == 1 && !text.empty()) text = mutator.mutate(text);
    Diagnostics diagnostics("m");
    const auto diagram = read_diagram(text, diagnostics);
    CAPTURE(seed, text);
    REQUIRE(diagram.has_value() == !diagnostics.failed());
    for (const Diagnostic& diagnostic : diagnostics.sorted()) {
      REQUIRE(diagnostic.at.line >= 1);
      REQUIRE(diagnostic.at.column >= 1);
      REQUIRE_FALSE(diagnostic.message.empty());
    }
    if (!diagram) ++refused;
  }
  // Most mutations break something; else the mutator or the reader does not do its work.
  CHECK(refused > 1000);
}
