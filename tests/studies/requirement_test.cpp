#include "studies/metrics/requirement.h"

#include <cmath>
#include <numbers>

#include "studies/file.h"
#include "tests/catch.h"
#include "tests/studies/hand_made_log.h"
#include "tests/studies/temporary_folder.h"

using namespace flyball;
using test::hand_made_log;
using test::TemporaryFolder;

namespace {

/// A step from 0 V to 10 V with an overshoot of a fifth, a ramp of 1 m/s, and a sine of 3 A.
Log sample() {
  const auto step = [](double t) { return t < 1.0 ? 0.0 : t < 2.0 ? 12.0 : 10.0; };
  return hand_made_log({{"y", "V", step},
                        {"ramp", "m", [](double t) { return t; }},
                        {"i", "A", [](double t) { return 3.0 * std::sin(2.0 * std::numbers::pi * t); }}},
                       10.0, 0.125);
}

Verdict verdict(const std::string& text, const std::filesystem::path& folder = {}) {
  const Log log = sample();
  return Requirement(text, log.columns(), folder).check(log);
}

std::string refusal(const std::string& text, const std::filesystem::path& folder = {}) {
  try {
    const Requirement requirement(text, sample().columns(), folder);
  } catch (const TextError& error) {
    return std::to_string(error.offset()) + ": " + error.what();
  }
  return "nothing is wrong";
}

/// A folder with files to compare with.
struct Files {
  TemporaryFolder folder;

  Files() {
    write("envelope.csv", "time [s],lower [m],upper [m]\n0,-1,1\n4,3,5\n10,9,11\n");
    write("upper.csv", "time [s],upper [m]\n2,2.5\n3,2.5\n3,100\n5,100\n");
    write("ramp.csv", "time,ramp\n0,0\n10,10\n");
    write("jump.csv", "time,y\n0,0\n1.05,0\n1.05,12\n2.05,12\n2.05,10\n10,10\n");
    write("late.csv", "time,ramp\n0,0\n20,20\n");
  }
  void write(const std::string& name, const std::string& text) const { write_file(folder / name, text); }
  Verdict verdict(const std::string& text) const { return ::verdict(text, folder / "."); }
};

}  // namespace

TEST_CASE("Requirement: a metric against a number") {
  const Verdict broken = verdict("overshoot(y) < 5 %");
  CHECK_FALSE(broken.passed);
  CHECK(broken.margin == Approx(-0.15).epsilon(1e-12));
  CHECK(broken.value == Approx(0.2).epsilon(1e-12));
  CHECK(std::isnan(broken.time));
  CHECK(broken.message == "overshoot(y) is 20 %, expected < 5 %");
  const Verdict kept = verdict("overshoot(y) <= 25 %");
  CHECK(kept.passed);
  CHECK(kept.margin == Approx(0.05).epsilon(1e-12));
}

TEST_CASE("Requirement: a limit itself passes <= and >=, but not < and >") {
  CHECK(verdict("max(y) <= 12 V").passed);
  CHECK(verdict("max(y) >= 12 V").passed);
  CHECK_FALSE(verdict("max(y) < 12 V").passed);
  CHECK_FALSE(verdict("max(y) > 12 V").passed);
  CHECK(verdict("max(y) < 12 V").margin == 0.0);
}

TEST_CASE("Requirement: a chain, turned sides, and what is compared with a metric") {
  CHECK(verdict("9 V < final(y) <= 10 V").passed);
  const Verdict below = verdict("11 V <= final(y) <= 12 V");
  CHECK_FALSE(below.passed);
  CHECK(below.margin == Approx(-1.0));
  CHECK(below.message == "final(y) is 10 V, expected >= 11 V");
  CHECK(verdict("max(y) < 1.1*final(y)").message == "max(y) is 12 V, expected < 1.1*final(y) = 11 V");
  CHECK(verdict("5000 mV > max(y)").message == "max(y) is 12000 mV, expected < 5000 mV");
}

TEST_CASE("Requirement: always") {
  const Verdict broken = verdict("always y <= 11 V");
  CHECK_FALSE(broken.passed);
  CHECK(broken.margin == Approx(-1.0));
  CHECK(broken.value == 12.0);
  CHECK(broken.time == 1.0);
  CHECK(broken.message == "y is 12 V at 1 s, expected <= 11 V");
  CHECK(verdict("always y <= 11 V after 2 s").passed);
  CHECK(verdict("always y <= 11 V before 0.875 s").passed);
  CHECK_FALSE(verdict("always y <= 11 V between 0.5 s and 1.5 s").passed);
  CHECK(verdict("always y <= 11 V between 2 s and 3 s").passed);
  CHECK(verdict("always abs(i) <= 3.001 A").passed);
  CHECK(verdict("always -3.001 A <= i <= 3.001 A").passed);
  CHECK(verdict("always 0 V <= y").passed);
  // The window ends between two rows: the ramp is 4.03 m there.
  CHECK(verdict("always ramp < 4.04 m before 4.03 s").margin == Approx(0.01).epsilon(1e-9));
}

TEST_CASE("Requirement: eventually") {
  CHECK(verdict("eventually ramp > 9 m").passed);
  const Verdict broken = verdict("eventually ramp > 9 m before 5 s");
  CHECK_FALSE(broken.passed);
  CHECK(broken.margin == Approx(-4.0));
  CHECK(broken.time == Approx(5.0));
  CHECK(broken.message == "ramp is 5 m at 5 s, where it is nearest, expected > 9 m");
}

TEST_CASE("Requirement: several statements hold together, and the tightest one tells") {
  const Verdict both = verdict("max(y) < 13 V and always y >= 0.5 V after 1 s and final(y) < 10.25 V");
  CHECK(both.passed);
  CHECK(both.margin == Approx(0.25));
  CHECK_FALSE(verdict("max(y) < 13 V and always y >= 0.5 V").passed);
  CHECK_FALSE(verdict("always y >= 0.5 V and max(y) < 13 V").passed);
}

TEST_CASE("Requirement: what has no value does not pass") {
  const Verdict none = verdict("settling(y, final = 20 V) < 3 s");
  CHECK_FALSE(none.passed);
  CHECK(std::isnan(none.margin));
  CHECK(none.message == "settling(y, final = 20 V) has no value, expected < 3 s");
  CHECK_FALSE(verdict("always y < 20 V after 11 s").passed);
  CHECK_FALSE(verdict("always y < 20 V after settling(y, final = 20 V)").passed);
  CHECK_FALSE(verdict("always y < 20 V between 3 s and 2 s").passed);
}

TEST_CASE("Requirement: the margin moves with the signal, without a step where it passes") {
  const auto margin = [](double height) {
    const Log log = hand_made_log({{"y", "V", [&](double t) { return height * std::sin(t); }}}, 3.0, 0.25);
    return Requirement("always y < 1 V", log.columns(), {}).check(log).margin;
  };
  const double slope = (margin(1.1) - margin(1.09)) / 0.01;
  CHECK((margin(0.9) - margin(0.89)) / 0.01 == Approx(slope).epsilon(1e-9));
  CHECK(margin(0.9) * margin(1.1) < 0.0);
}

TEST_CASE("Requirement: an envelope") {
  const Files files;
  const Verdict inside = files.verdict("ramp within \"envelope.csv\"");
  CHECK(inside.passed);
  CHECK(inside.margin == Approx(1.0));
  CHECK(files.verdict("ramp within envelope.csv").passed);
  // Past the jump at 3 s there is room; before it the ramp is at 3 m where 2.5 m are allowed.
  const Verdict broken = files.verdict("ramp within upper.csv");
  CHECK_FALSE(broken.passed);
  CHECK(broken.value == Approx(2.875));
  CHECK(broken.time == Approx(2.875));
  CHECK(broken.message == "ramp is 2.875 m at 2.875 s, expected at most 2.5 m");
}

TEST_CASE("Requirement: an envelope is also looked at between the rows of the run") {
  const Files files;
  // A notch that is narrower than the rows of the run are apart.
  files.write("notch.csv", "time,upper\n0,20\n5.01,20\n5.02,4\n5.03,20\n10,20\n");
  const Verdict broken = files.verdict("ramp within notch.csv");
  CHECK_FALSE(broken.passed);
  CHECK(broken.time == Approx(5.02));
  CHECK(broken.margin == Approx(4.0 - 5.02).epsilon(1e-9));
}

TEST_CASE("Requirement: a baseline with tolerances") {
  const Files files;
  CHECK(files.verdict("ramp matches ramp.csv").margin == Approx(0.0).margin(1e-12));
  CHECK(files.verdict("ramp matches \"ramp.csv\" (absolute 10 mm)").margin == Approx(0.01).epsilon(1e-9));
  const Verdict off = files.verdict("1.02*ramp matches ramp.csv (relative 1 %, absolute 1 cm)");
  CHECK_FALSE(off.passed);
  // At 10 m: 0.2 m off, 0.1 m and 0.01 m allowed.
  CHECK(off.margin == Approx(-0.09).epsilon(1e-9));
  CHECK(off.message == "1.02*ramp is 1020 cm at 10 s, expected 989 cm to 1011 cm");
  // Early or late by 0.1 s, a ramp of 1 m/s is off by 0.1 m; the ends of the baseline go on as they are.
  CHECK(files.verdict("ramp - 0.09 m matches ramp.csv (time 0.1 s)").margin == Approx(-0.09).margin(1e-9));
  CHECK(files.verdict("ramp matches ramp.csv (time 0.1 s)").passed);
}

TEST_CASE("Requirement: a jump may come early or late by the time tolerance") {
  const Files files;
  CHECK_FALSE(files.verdict("y matches jump.csv (absolute 0.1 V)").passed);
  // The run is at 12 V at 1 s, the baseline from 1.05 s on.
  CHECK_FALSE(files.verdict("y matches jump.csv (absolute 0.1 V, time 49 ms)").passed);
  CHECK(files.verdict("y matches jump.csv (absolute 0.1 V, time 51 ms)").passed);
}

TEST_CASE("Requirement: a run that ends before its baseline does not match it") {
  const Files files;
  const Verdict early = files.verdict("ramp matches late.csv");
  CHECK_FALSE(early.passed);
  CHECK(early.message == "the run ends at 10 s, late.csv at 20 s");
}

TEST_CASE("Requirement: unit of margin and value, and what it reads") {
  const auto columns = sample().columns();
  CHECK(Requirement("overshoot(y) < 5 %", columns, {}).unit() == "1");
  CHECK(Requirement("always y < 5 mV", columns, {}).unit() == "V");
  CHECK(Requirement("final(y) < 3 V", columns, {}).reads_end_only());
  CHECK_FALSE(Requirement("always y < 3 V", columns, {}).reads_end_only());
  CHECK_FALSE(Requirement("max(y) < 3 V", columns, {}).reads_end_only());
}

TEST_CASE("Requirement: what is wrong is said where it is") {
  const Files files;
  const auto refused = [&](const std::string& text) { return refusal(text, files.folder / "."); };
  CHECK(refused("overshoot(y)") ==
        "12: expected a comparison with <, <=, > or >=, or \"within\" or \"matches\" and a file");
  CHECK(refused("y < 3 V") ==
        "0: y changes over time: say which number of it is meant, such as final(y) or max(y)");
  CHECK(refused("max(y) < 3 A") == "9: expected V, found A");
  CHECK(refused("always y < 3 V after 2 V") == "21: expected s, found V");
  CHECK(refused("always y < 3 V between 2 s") ==
        "26: expected \"and\" and the end of the time behind \"between\"");
  CHECK(refused("max(y) < 3 V and max(i) < 2 A") ==
        "17: this statement is about A, the first one about V: make them two requirements");
  CHECK(refused("max(y) < 3 V or max(y) < 4 V") == "13: unexpected \"o\"");
  CHECK(refused("y within nothing.csv").starts_with("9: "));
  CHECK(refused("y within ") == "9: expected the name of a CSV file in quotes");
  CHECK(refused("y within \"envelope.csv") == "9: expected the name of a CSV file in quotes");
  CHECK(refused("y within envelope.csv") == "9: the signal is in V, the column of the file in m");
  CHECK(refused("y within ramp.csv")
            .ends_with(
                "ramp.csv:1:1: error: an envelope has the columns time, lower and upper, or one of the two"));
  CHECK(refused("y matches envelope.csv")
            .ends_with("error: there is no column \"y\"; known: time, lower, upper"));
  CHECK(refused("ramp matches ramp.csv (absolut 1 m)") ==
        "23: expected absolute, relative, time or column, found \"absolut\"");
  CHECK(refused("ramp matches ramp.csv (absolute 1 A)") == "32: expected m, found A");
  CHECK(refused("ramp matches ramp.csv (relative 200 %)") ==
        "23: the relative tolerance must be below 100 %");
  CHECK(refused("ramp matches ramp.csv (absolute -1 m)") == "32: the absolute tolerance is below 0");
  CHECK(refused("ramp matches ramp.csv (absolute 1 m") ==
        "35: expected \")\": the expression ends too early");
  files.write("reversed.csv", "time,lower,upper\n0,0,1\n1,2,1\n");
  CHECK(refused("y within reversed.csv").ends_with("reversed.csv:3:1: error: lower is above upper at 1 s"));
}
