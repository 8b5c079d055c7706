#include "studies/metrics/junit.h"

#include <fmt/format.h>

#include <iterator>

#include "studies/xml.h"

namespace flyball {
namespace {

void append_suite(const JUnitSuite& suite, std::string& xml) {
  const auto out = std::back_inserter(xml);
  const std::string name = xml_attribute(suite.name);
  const auto& requirements = suite.assessment->requirements;
  fmt::format_to(out, "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"0\" skipped=\"0\">\n",
                 name, requirements.size(), suite.assessment->failed());
  if (!suite.assessment->metrics.empty()) {
    xml += "    <properties>\n";
    for (const MetricResult& metric : suite.assessment->metrics) {
      fmt::format_to(out, "      <property name=\"{}\" value=\"{}{}\"/>\n", xml_attribute(metric.name),
                     metric.value,
                     metric.unit == "1" || metric.unit.empty() ? "" : ' ' + xml_attribute(metric.unit));
    }
    xml += "    </properties>\n";
  }
  for (const auto& [label, text, unit, verdict] : requirements) {
    const std::string message = xml_attribute(verdict.message);
    fmt::format_to(out, "    <testcase classname=\"{}\" name=\"{}\"", name, xml_attribute(label));
    if (verdict.passed) {
      fmt::format_to(out, ">\n      <system-out>{}: {}</system-out>\n    </testcase>\n", xml_attribute(text),
                     message);
    } else {
      fmt::format_to(out, ">\n      <failure type=\"requirement\" message=\"{0}\">{1}: {0}</failure>\n",
                     message, xml_attribute(text));
      xml += "    </testcase>\n";
    }
  }
  xml += "  </testsuite>\n";
}

}  // namespace

std::string junit_xml(const std::vector<JUnitSuite>& suites) {
  std::size_t tests = 0;
  long failures = 0;
  std::string body;
  for (const JUnitSuite& suite : suites) {
    tests += suite.assessment->requirements.size();
    failures += suite.assessment->failed();
    append_suite(suite, body);
  }
  return fmt::format(
             "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"flyball\" tests=\"{}\" "
             "failures=\"{}\" errors=\"0\">\n",
             tests, failures) +
         body + "</testsuites>\n";
}

}  // namespace flyball
