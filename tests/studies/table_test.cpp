#include "studies/table.h"

#include "tests/catch.h"

using namespace flyball;

TEST_CASE("Table: numbers stand on their decimal points, names at the left") {
  Table table({"signal", "final", "unit"});
  table.row({"H", "-13.25", "m"});
  table.row({"robot.pose.x", "7", "m"});
  table.row({"θ", "0.125", ""});
  table.row({"tiny", "1.5e-07"});
  CHECK(table.text() ==
        "signal            final  unit\n"
        "H             -13.25     m\n"
        "robot.pose.x    7        m\n"
        "θ               0.125\n"
        "tiny            1.5e-07\n");
}

TEST_CASE("Table: headings above groups of columns") {
  Table table({"gain", "run", "linear", "run", "linear"});
  table.group(1, 2, "overshoot [%]");
  table.group(3, 2, "a long heading, wider than its columns");
  table.row({"0.2", "55.78", "55.8", "1", "2"});
  CHECK(table.text() ==
        "      overshoot [%]  a long heading, wider than its columns\n"
        "gain    run  linear  run                             linear\n"
        " 0.2  55.78    55.8    1                                  2\n");
}
