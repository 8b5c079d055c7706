// Formatting changes what a model looks like, and nothing else.
#include "models/language/format.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include "models/language/toml.h"
#include "tests/source_dir.h"
#include "tests/systems/harness.h"

using namespace flyball;
using namespace flyball::test;

namespace {

/// Models of a random chain of blocks, written with random blanks, comments and line breaks.
class RandomModel {
 public:
  explicit RandomModel(unsigned seed) : random_(seed) {}

  std::string text() {
    const int n = pick(2, 8);
    line("flyball" + equals() + "1");
    section("parameters");
    line("K" + equals() + std::to_string(pick(1, 9)) + ".5");
    if (pick(0, 1) != 0)
      line("tau" + equals() + "{value" + equals() + "\"" + std::to_string(pick(1, 9)) + "00 ms\"" + comma() +
           "doc='a # in a string'}");
    section("blocks");
    line("source" + equals() + "{type" + equals() + "\"SineWave\"" + comma() + "frequency" + equals() +
         std::to_string(pick(1, 5)) + ".0}");
    for (int k = 0; k < n; ++k) line("b" + std::to_string(k) + equals() + block());
    section("diagram");
    wires(n);
    line("log" + equals() + "[" + blank() + "\"b0\"" + comma() + "\"b" + std::to_string(n - 1) + "\"" +
         (pick(0, 1) != 0 ? "," : "") + "]");
    section("simulation");
    line("stop" + equals() + "0.5");
    line("solver" + equals() + "{method" + equals() + "\"rk4\"" + comma() + "step=0.01}");
    return text_;
  }

 private:
  int pick(int from, int to) { return std::uniform_int_distribution<int>(from, to)(random_); }
  std::string blank() {
    return std::string(static_cast<std::size_t>(pick(0, 3)), pick(0, 1) != 0 ? ' ' : '\t');
  }
  std::string equals() { return blank() + "=" + blank(); }
  std::string comma() { return blank() + "," + blank(); }

  void line(const std::string& content) {
    if (pick(0, 5) == 0) text_ += blank() + "# a comment, [not] a = section\n";
    if (pick(0, 5) == 0) text_ += std::string(static_cast<std::size_t>(pick(1, 3)), '\n');
    text_ += blank() + content + blank();
    if (pick(0, 4) == 0) text_ += "#behind";
    text_ += pick(0, 9) == 0 ? "\r\n" : "\n";
  }
  void section(const std::string& name) { line("[" + blank() + name + blank() + "]"); }

  std::string block() {
    switch (pick(0, 3)) {
      case 0:
        return "{ type = \"Gain\"" + comma() + "gain" + equals() + "\"2*K\" }";
      case 1:
        return "{type='Integrator'" + comma() + "initial" + equals() + std::to_string(pick(-3, 3)) + ".25}";
      case 2:
        return "{ type=\"Saturation\"" + comma() + "lower = -1.0" + comma() + "upper=1.0}";
      default:
        return "{ type = \"TransferFcn\"" + comma() + "numerator = [" + blank() + "1.0]" + comma() +
               "denominator = [1.0" + comma() + std::to_string(pick(1, 5)) + ".0] }";
    }
  }

  void wires(int n) {
    std::string list = "wires" + equals() + "[";
    if (pick(0, 1) != 0) list += "# of the chain\n";
    list += "\"source -> b0\"";
    for (int k = 1; k < n; ++k) {
      list += comma() + (pick(0, 2) == 0 ? "\n" : "") + (pick(0, 4) == 0 ? "# next\n" : "");
      list += "\"b" + std::to_string(k - 1) + " -> b" + std::to_string(k) + "\"";
    }
    line(list + blank() + (pick(0, 1) != 0 ? ",\n" : "") + "]");
  }

  std::mt19937 random_;
  std::string text_;
};

std::vector<double> simulated(const std::string& text) {
  Model model = read_model(text);
  Simulator simulator(model.plan, model.settings);
  simulator.run();
  return simulator.log().data();
}

}  // namespace

TEST_CASE("A thousand random models say and do the same after formatting, which settles at once") {
  for (unsigned seed = 0; seed < 1000; ++seed) {
    const std::string text = RandomModel(seed).text();
    const std::string formatted = format_toml(text);
    INFO("seed " << seed << '\n' << text << "\n-----\n" << formatted);
    REQUIRE(format_toml(formatted) == formatted);
    Diagnostics diagnostics("model.toml");
    REQUIRE(same_content(parse_toml(text, diagnostics)->root(), parse_toml(formatted, diagnostics)->root()));
    REQUIRE(simulated(text) == simulated(formatted));
    const auto comments = [](const std::string& t) { return std::count(t.begin(), t.end(), '#'); };
    REQUIRE(comments(text) == comments(formatted));
  }
}

TEST_CASE("The shipped models have the one layout") {
  for (const auto& entry : std::filesystem::recursive_directory_iterator(source_dir() + "/models")) {
    if (entry.path().extension() != ".toml") continue;
    std::ifstream file(entry.path());
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    INFO(entry.path());
    CHECK(format_toml(text) == text);
  }
}
