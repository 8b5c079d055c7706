#include "studies/metrics/junit.h"

#include <fmt/format.h>

#include <iterator>

#include "models/language/source_text.h"

namespace flyball {
namespace {

void append_suite(const JUnitSuite& suite, std::string& xml) {
  const auto out = std::back_inserter(xml);
  const std::string name = xml_escaped(suite.name);
  const auto& requirements = suite.assessment->requirements;
  fmt::format_to(out, "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"0\" skipped=\"0\">\n",
                 name, requirements.size(), suite.assessment->failed());
  if (!suite.assessment->metrics.empty()) {
    xml += "    <properties>\n";
    for (const MetricResult& metric : suite.assessment->metrics) {
      fmt::format_to(out, "      <property name=\"{}\" value=\"{}{}\"/>\n", xml_escaped(metric.name),
                     metric.value,
                     metric.unit == "1" || metric.unit.empty() ? "" : ' ' + xml_escaped(metric.unit));
    }
    xml += "    </properties>\n";
  }
  for (const auto& [label, text, unit, verdict] : requirements) {
    const std::string message = xml_escaped(verdict.message);
    fmt::format_to(out, "    <testcase classname=\"{}\" name=\"{}\"", name, xml_escaped(label));
    if (verdict.passed) {
      fmt::format_to(out, ">\n      <system-out>{}: {}</system-out>\n    </testcase>\n", xml_escaped(text),
                     message);
    } else {
      fmt::format_to(out, ">\n      <failure type=\"requirement\" message=\"{0}\">{1}: {0}</failure>\n",
                     message, xml_escaped(text));
      xml += "    </testcase>\n";
    }
  }
  xml += "  </testsuite>\n";
}

}  // namespace

std::string xml_escaped(std::string_view text) {
  constexpr std::string_view replacement = "\xEF\xBF\xBD";
  std::string escaped;
  while (!text.empty()) {
    const auto bad = find_invalid_utf8(text);
    for (const char c : text.substr(0, bad.value_or(text.size()))) {
      const bool control = static_cast<unsigned char>(c) < ' ' && c != '\n' && c != '\t' && c != '\r';
      if (control) {
        escaped += replacement;
      } else if (c == '&') {
        escaped += "&amp;";
      } else if (c == '<') {
        escaped += "&lt;";
      } else if (c == '>') {
        escaped += "&gt;";
      } else if (c == '"') {
        escaped += "&quot;";
      } else if (c == '\n' || c == '\r' || c == '\t') {
        // A reader of XML makes a blank of them in attributes.
        escaped += fmt::format("&#{};", static_cast<int>(c));
      } else {
        escaped += c;
      }
    }
    if (!bad) break;
    escaped += replacement;
    text.remove_prefix(*bad + 1);
  }
  return escaped;
}

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
