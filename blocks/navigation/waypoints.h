#pragma once
#include "blocks/block.h"
#include "blocks/navigation/path.h"

namespace flyball {

struct Waypoints : Block {
  static constexpr auto summary = "A path through given points.";
  NumberRows points =
      lengths("points", {{0.0, 0.0}, {1.0, 0.0}}, "x and y of each point; the path begins at the first");
  std::optional<NumberRows> from_file = columns("file", {"x", "y"}, "m");
  ObjectOutput<Path> path = object_output<Path>("path", made(), "the points");

 private:
  std::shared_ptr<const Path> made() {
    if (given("file") && given("points")) refuse("points", "the points are those of the file");
    const NumberRows& rows = from_file ? *from_file : points;
    const char* key = from_file ? "file" : "points";
    for (const auto& row : rows) {
      if (row.size() == 2) continue;
      refuse(key, "expected two lengths, x and y, found " + std::to_string(row.size()));
      return std::make_shared<const Path>();
    }
    if (rows.size() >= 2) return std::make_shared<const Path>(rows);
    refuse(key, "expected at least two points, found " + std::to_string(rows.size()));
    return std::make_shared<const Path>();
  }
};

}  // namespace flyball
