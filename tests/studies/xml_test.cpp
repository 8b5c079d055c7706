#include "studies/xml.h"

#include "tests/catch.h"

using namespace flyball;

TEST_CASE("XML: what has a meaning of its own is escaped") {
  CHECK(xml_text("a<b & \"c\">") == "a&lt;b &amp; &quot;c&quot;&gt;");
  CHECK(xml_text("</script><!-- -->") == "&lt;/script&gt;&lt;!-- --&gt;");
}

TEST_CASE("XML: ends of lines stay, in attributes by their number") {
  CHECK(xml_text("one\n\ttwo") == "one\n\ttwo");
  CHECK(xml_attribute("one\n\ttwo") == "one&#10;&#9;two");
}

TEST_CASE("XML: what it cannot hold is replaced") {
  const std::string replaced = "\xEF\xBF\xBD";
  CHECK(xml_text(std::string("a\x01z")) == "a" + replaced + "z");
  CHECK(xml_text("a\xff\xfez µ") == "a" + replaced + replaced + "z µ");
  CHECK(xml_attribute("\xc3") == replaced);
}
