#include "tools/reference.h"

#include "tests/catch.h"
#include "tools/json.h"

using namespace flyball;

TEST_CASE("Reference: each page shows all that the block declares") {
  for (const BlockType& type : catalogue()) {
    INFO(type.name);
    const std::string page = reference_page(type);
    CHECK_THAT(page, Catch::StartsWith("# " + type.name + "\n\n" + type.summary));
    const BlockObject object = type.create();
    for (const SlotSpec& slot : object.specification->slots) {
      const bool is_port = slot.kind == SlotKind::input || slot.kind == SlotKind::output;
      if (slot.kind == SlotKind::time || slot.kind == SlotKind::memory || slot.fixed || is_port) continue;
      INFO(slot.name);
      CHECK_THAT(page, Catch::Contains("| `" + slot.name + "` |") && Catch::Contains(slot.doc));
    }
    for (const PortSpec& port : object.specification->ports) {
      CHECK_THAT(page, Catch::Contains("| `" + port.name + "` |"));
    }
    for (const StructureSpec& key : object.specification->structure) {
      CHECK_THAT(page, Catch::Contains("| `" + key.key + "` |"));
    }
    CHECK_THAT(reference_index(),
               Catch::Contains("[" + type.name + "](" + type.name + ".md) | " + type.summary));
    CHECK_THAT(block_list(), Catch::Contains(type.name));
  }
}

TEST_CASE("Reference: what reads what comes from the equations") {
  const std::string page = reference_page(*find_block_type("Gain"));
  CHECK_THAT(page, Catch::Contains("| `y` | `gain`, `u` |"));
  CHECK_THAT(reference_page(*find_block_type("PID")), Catch::Contains("| rate of `integral` | `Ki`, `e` |"));
}

TEST_CASE("Reference: a page says under which other names its block is accepted") {
  CHECK_THAT(reference_page(*find_block_type("Gain")),
             Catch::Contains("Also accepted as: `Modelica.Blocks.Math.Gain`, `GAINBLK`, `GAINBLK_f`."));
}

TEST_CASE("Reference: ranges read like mathematics") {
  CHECK(to_string(any) == "any");
  CHECK(to_string(positive) == "> 0");
  CHECK(to_string(non_negative) == ">= 0");
  CHECK(to_string(unit_interval) == "[0, 1]");
  CHECK(to_string(Range{0.0, 1.0, true, true}) == "(0, 1)");
  CHECK(to_string(Range{-infinity, 2.5}) == "<= 2.5");
}

TEST_CASE("Reference: JSON has every block") {
  std::vector<const BlockType*> types;
  for (const BlockType& type : catalogue()) types.push_back(&type);
  const std::string json = blocks_json(types);
  for (const BlockType& type : catalogue())
    CHECK_THAT(json, Catch::Contains("\"name\": \"" + type.name + "\""));
}
