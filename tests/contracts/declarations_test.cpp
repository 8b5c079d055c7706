// What every declaration must say.
#include <set>

#include "tests/catch.h"
#include "tests/contracts/cases.h"

namespace flyball::test {

TEST_CASE("slots, ports and structure are named and explained, and slots have units") {
  for (const Case& c : cases()) {
    const BlockObject object = c.object();
    INFO(c.type << " (" << c.label << ")");
    const std::string& summary = object.type->summary;
    CHECK((!summary.empty() && summary.back() == '.'));
    for (const SlotSpec& slot : object.specification->slots) {
      INFO("slot " << slot.name);
      CHECK_FALSE(slot.name.empty());
      CHECK_FALSE(slot.doc.empty());
      if (slot.numeric()) CHECK_FALSE(slot.unit.empty());
    }
    for (const SlotSpec& slot : object.specification->absent) {
      INFO("slot of another structure " << slot.name);
      CHECK((!slot.name.empty() && !slot.doc.empty() && !slot.unit.empty()));
    }
    for (const PortSpec& port : object.specification->ports) {
      INFO("port " << port.name);
      CHECK_FALSE(port.doc.empty());
      CHECK(port.slots.size() == (port.elements.empty() ? 1 : port.elements.size()));
    }
    for (const StructureSpec& key : object.specification->structure) {
      INFO("key " << key.key);
      CHECK((!key.key.empty() && !key.doc.empty() && !key.fallback.empty()));
    }
  }
}

TEST_CASE("a name stands for one port, and for one number of its kind") {
  for (const Case& c : cases()) {
    const BlockObject object = c.object();
    std::set<std::string> ports;
    for (const PortSpec& port : object.specification->ports) {
      INFO(c.type << " (" << c.label << "): port " << port.name);
      CHECK(ports.insert(port.name).second);
    }
    std::set<std::pair<bool, std::string>> slots;
    for (const SlotSpec& slot : object.specification->slots) {
      INFO(c.type << " (" << c.label << "): slot " << slot.name);
      CHECK(slots.insert({slot.kind == SlotKind::param, slot.name}).second);
    }
  }
}

TEST_CASE("defaults lie in their ranges") {
  for (const Case& c : cases()) {
    const BlockObject object = c.object();
    for (const SlotSpec& slot : object.specification->slots) {
      if (slot.kind != SlotKind::param) continue;
      INFO(c.type << " (" << c.label << "): parameter " << slot.name);
      CHECK(slot.range.contains(slot.fallback));
    }
  }
}

TEST_CASE("block types are found by their names and aliases, which are unique") {
  std::set<std::string> names;
  for (const BlockType& type : catalogue()) {
    std::vector<std::string> all = type.aliases;
    all.push_back(type.name);
    for (const std::string& name : all) {
      INFO(name);
      CHECK(names.insert(name).second);
      CHECK(find_block_type(name) == &type);
    }
  }
  CHECK(names == std::set<std::string>(block_type_names().begin(), block_type_names().end()));
  CHECK(find_block_type("GAINBLK_f") == find_block_type("Gain"));
  CHECK(find_block_type("Modelica.Blocks.Continuous.Integrator") == find_block_type("Integrator"));
  CHECK(find_block_type("Modelica.Blocks.Discrete.TransferFunction") ==
        find_block_type("DiscreteTransferFcn"));
  CHECK(find_block_type("DLSS") == find_block_type("DiscreteStateSpace"));
  CHECK(find_block_type("Gian") == nullptr);
}

}  // namespace flyball::test
