#include "models/language/toml.h"

#include <array>

#include "tests/catch.h"

using namespace flyball;

namespace {

TomlDocument parsed(std::string_view text) {
  Diagnostics diagnostics("m");
  auto document = parse_toml(text, diagnostics);
  REQUIRE_FALSE(diagnostics.failed());
  return *std::move(document);
}

}  // namespace

TEST_CASE("a tree keeps the order of the text and every position") {
  const TomlDocument document =
      parsed("zeta = 1\nalpha = { y = 2.50, b = [true, 'x'] }\n[section]\n  key = 1979-05-27\n");
  const TomlValue& root = document.root();
  REQUIRE(root.entries.size() == 3);
  CHECK(root.entries[0].key == "zeta");
  CHECK(root.entries[0].value.integer == 1);
  CHECK(root.entries[0].value.number == 1.0);
  CHECK(root.entries[0].value.at == Position{1, 8});
  CHECK(root.entries[1].key == "alpha");
  const TomlValue& inner = root.entries[1].value;
  REQUIRE(inner.entries.size() == 2);
  CHECK(inner.entries[0].key == "y");
  CHECK(inner.entries[0].at == Position{2, 11});
  CHECK(inner.entries[0].value.text == "2.50");
  const TomlValue* list = inner.find("b");
  REQUIRE(list != nullptr);
  REQUIRE(list->items.size() == 2);
  CHECK(list->items[0].flag);
  CHECK(list->items[1].text == "x");
  CHECK(list->items[1].at == Position{2, 32});
  CHECK(root.find("section")->entries[0].value.is(TomlValue::Kind::date));
  CHECK(root.find("section")->entries[0].at == Position{4, 3});
  CHECK(root.find("nothing") == nullptr);
}

TEST_CASE("numbers keep how they were written") {
  const TomlDocument document = parsed("a = 1_000.5\nb = 1e-3 # comment\nc = [0.10, -2.0]\n");
  CHECK(document.root().find("a")->text == "1000.5");
  CHECK(document.root().find("b")->text == "1e-3");
  CHECK(document.root().find("c")->items[0].text == "0.10");
  CHECK(document.root().find("c")->items[1].text == "-2.0");
}

TEST_CASE("columns count characters, however long the line") {
  // Characters of one to four bytes, in an order that is not the same at each multiple of a power of two.
  std::string text = "a\n";
  std::vector<std::size_t> starts;
  for (int k = 0; k < 1000; ++k) {
    starts.push_back(text.size());
    text += std::array{"x", "\u00E9", "\u20AC", "\U0001F600", "yz"}[k % 7 % 5];
    if (k % 7 % 5 == 4) starts.push_back(text.size() - 1);
  }
  const SourceText source(text);
  for (std::size_t k = 0; k < starts.size(); ++k) {
    const Position at{2, static_cast<int>(k) + 1};
    CHECK(source.position(starts[k]) == at);
    CHECK(source.offset(at) == starts[k]);
  }
  CHECK(source.offset({2, static_cast<int>(starts.size()) + 5}) == text.size());
}

TEST_CASE("columns count characters, with any kind of quotes") {
  const TomlDocument document = parsed(
      "# \u00E9\na = \"\u00E9x\" # \u00E9\nb = 'a\\b'\nc = \"a\\tb\\u00e9c\"\nd = "
      "\"\"\"\nfirst\nsecond\"\"\"\ne = \"\"\"x\\\n   y\"\"\"\n");
  const auto at = [&](std::string_view key, std::size_t offset) {
    return document.inside(*document.root().find(key), offset);
  };
  CHECK(at("a", 0) == Position{2, 6});
  CHECK(at("a", 2) == Position{2, 7});  // the first character has two bytes
  CHECK(at("b", 2) == Position{3, 8});
  CHECK(at("c", 2) == Position{4, 9});   // "b", behind a tab of two characters
  CHECK(at("c", 5) == Position{4, 16});  // "c", behind a character of six and of two bytes
  CHECK(at("d", 0) == Position{6, 1});
  CHECK(at("d", 6) == Position{7, 1});
  CHECK(at("e", 1) == Position{9, 4});
}

TEST_CASE("a byte order mark and carriage returns do not count") {
  const TomlDocument document = parsed(
      "\xEF\xBB\xBF"
      "a = 1\r\nb = 2\r\n");
  CHECK(document.root().entries[0].at == Position{1, 1});
  CHECK(document.root().entries[1].at == Position{2, 1});
}

TEST_CASE("text that is not UTF-8 is found at its first byte") {
  const auto bad = [](std::string_view text) { return find_invalid_utf8(text); };
  CHECK(bad("abc \u00E9 \u20AC \U0001F600") == std::nullopt);
  CHECK(bad("ab\x80") == 2u);
  CHECK(bad("a\xC3") == 1u);
  CHECK(bad("\xC0\xAF") == 0u);          // overlong
  CHECK(bad("\xE0\x80\xAF") == 0u);      // overlong
  CHECK(bad("x\xED\xA0\x80") == 1u);     // a surrogate
  CHECK(bad("\xF4\x90\x80\x80") == 0u);  // beyond the last character
}

TEST_CASE("nesting is judged outside strings and comments") {
  CHECK(find_deep_nesting("a = [[1], [2]]", 2) == std::nullopt);
  CHECK(find_deep_nesting("a = [[1], [2]]", 1) == 5u);
  CHECK(find_deep_nesting("a = \"[[[\" # [[[\nb = '[[['\nc = \"\"\"[[[\n\"\"\"", 1) == std::nullopt);
  CHECK(find_deep_nesting("a.b.c = 1.5", 2) == std::nullopt);
  CHECK(find_deep_nesting("a.b.c = 1.5", 1) == 3u);
}
