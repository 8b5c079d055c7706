#include "studies/metrics/junit.h"

#include "tests/catch.h"

using namespace flyball;

TEST_CASE("JUnit: a suite with a passed and a failed requirement") {
  Assessment assessment;
  assessment.metrics.push_back({"settling", "settling(y)", "s", 0.25});
  assessment.requirements.push_back({"calm", "overshoot(y) < 5 %", "1", {true, 0.04, 0.01, 0.0, "is 1 %"}});
  assessment.requirements.push_back({"low", "max(y) < 5 V", "V", {false, -1.0, 6.0, 0.0, "is 6 V"}});
  CHECK(junit_xml({{"servo.toml", &assessment}}) ==
        R"(<?xml version="1.0" encoding="UTF-8"?>
<testsuites name="flyball" tests="2" failures="1" errors="0">
  <testsuite name="servo.toml" tests="2" failures="1" errors="0" skipped="0">
    <properties>
      <property name="settling" value="0.25 s"/>
    </properties>
    <testcase classname="servo.toml" name="calm">
      <system-out>overshoot(y) &lt; 5 %: is 1 %</system-out>
    </testcase>
    <testcase classname="servo.toml" name="low">
      <failure type="requirement" message="is 6 V">max(y) &lt; 5 V: is 6 V</failure>
    </testcase>
  </testsuite>
</testsuites>
)");
}
