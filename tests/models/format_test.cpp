#include "models/language/format.h"

#include <string>

#include "models/language/toml.h"
#include "tests/catch.h"

using namespace flyball;

namespace {

struct Layout {
  std::string what, before, after;
};

const Layout layouts[] = {
    {"blanks and the equals sign", "a=1\n", "a = 1\n"},
    {"equals signs of lines that follow each other", "a = 1\nlong=2\n\nb=3\n",
     "a    = 1\nlong = 2\n\nb = 3\n"},
    {"a comment begins a group of its own", "a = 1\n# why\nlong = 2\n", "a = 1\n# why\nlong = 2\n"},
    {"comments behind values", "a = 1#one\nb = [1, # one\n2]   # two\n",
     "a = 1  #one\nb = [\n  1,  # one\n  2,\n]  # two\n"},
    {"inline tables", "x={type=\"Gain\" ,gain=2.0}\ny = {}\n",
     "x = { type = \"Gain\", gain = 2.0 }\ny = {}\n"},
    {"lists keep their line breaks", "w = [\"a -> b\",\n\"c -> d\", \"e -> f\"\n]\n",
     "w = [\n  \"a -> b\",\n  \"c -> d\", \"e -> f\",\n]\n"},
    {"lists in lists", "A=[[1,2],\n[3,4]]\n", "A = [\n  [1, 2],\n  [3, 4],\n]\n"},
    {"comments inside a list", "w = [\n# first\n1,\n2, # two\n# last\n]\n",
     "w = [\n  # first\n  1,\n  2,  # two\n  # last\n]\n"},
    {"sections stand apart", "a = 1\n[ b . c ]\nd = 2\n# about e\n[e]\n",
     "a = 1\n\n[b.c]\nd = 2\n# about e\n[e]\n"},
    {"no blank lines at the ends, one between", "\n\na = 1\n\n\n\nb = 2\n\n\n", "a = 1\n\nb = 2\n"},
    {"line ends of other systems, and no last one",
     "\xEF\xBB\xBF"
     "a = 1\r\n  b = 2  \r\n",
     "a = 1\nb = 2\n"},
    {"strings are not touched", "a = 'x  #  =  y'\nb = \"q\\\" [ # \"\n",
     "a = 'x  #  =  y'\nb = \"q\\\" [ # \"\n"},
    {"strings over several lines", "a = \"\"\"\n  x  \n#y\"\"\"\"\nb = 1\n",
     "a = \"\"\"\n  x  \n#y\"\"\"\"\nb = 1\n"},
    {"quoted and dotted keys", "\"a b\" . 'c' = 1\n", "\"a b\".'c' = 1\n"},
    {"a name beyond ASCII counts by its characters", "\"é\" = 1\nab = 2\n", "\"é\" = 1\nab  = 2\n"},
    {"a date and its time", "d = 1979-05-27 07:32:00 # then\n", "d = 1979-05-27 07:32:00  # then\n"},
    {"lists of tables", "[[ plot ]]\ntitle = 'a'\n[[plot]]\n", "[[plot]]\ntitle = 'a'\n\n[[plot]]\n"},
    {"nothing", "", ""},
    {"only blank lines", "\n \n", ""},
};

TomlDocument parsed(const std::string& text) {
  Diagnostics diagnostics("model.toml");
  auto document = parse_toml(text, diagnostics);
  REQUIRE(document);
  return *std::move(document);
}

}  // namespace

TEST_CASE("A model file has one layout") {
  for (const Layout& layout : layouts) {
    INFO(layout.what);
    CHECK(format_toml(layout.before) == layout.after);
    CHECK(format_toml(layout.after) == layout.after);
    CHECK(same_content(parsed(layout.before).root(), parsed(layout.after).root()));
  }
}

TEST_CASE("Content is the same only where every value is") {
  const auto same = [](const std::string& a, const std::string& b) {
    return same_content(parsed(a).root(), parsed(b).root());
  };
  CHECK(same("a = 1.0\nb = [1, {c = 'x'}]", "a = 1.00\nb = [ 1, { c = \"x\" } ]"));
  CHECK_FALSE(same("a = 1", "a = 1.0"));
  CHECK_FALSE(same("a = 1", "a = 2"));
  CHECK_FALSE(same("a = 1", "b = 1"));
  CHECK_FALSE(same("a = 'x '", "a = 'x'"));
  CHECK_FALSE(same("a = [1]", "a = [1, 1]"));
  CHECK_FALSE(same("a = true", "a = false"));
  CHECK_FALSE(same("a = {b = 1}", "a = {}"));
}
