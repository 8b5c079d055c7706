#include "studies/figure.h"

#include "studies/file.h"
#include "studies/gnuplot.h"
#include "tests/catch.h"
#include "tests/studies/temporary_folder.h"

using namespace flyball;
using flyball::test::TemporaryFolder;

namespace {

/// While it lives, no program is found by its name.
class NoPrograms {
 public:
  NoPrograms() { setenv("PATH", "/nonexistent", 1); }
  ~NoPrograms() { setenv("PATH", old_.c_str(), 1); }

 private:
  std::string old_ = getenv("PATH");
};

const std::vector<LogColumn> columns{{"x", "m", 1}, {"phi", "rad", 2}, {"y", "m", 3}};

}  // namespace

TEST_CASE("Figure: signals that share a unit share a panel, in the order of the columns") {
  const Figure figure = figure_of(columns, "Title", "run.csv");
  REQUIRE(figure.panels.size() == 2);
  CHECK(figure.panels[0].label == "[m]");
  CHECK(figure.panels[1].label == "phi [rad]");
  REQUIRE(figure.panels[0].curves.size() == 2);
  CHECK(figure.panels[0].curves[1].label == "y");
  CHECK(figure.panels[0].curves[1].column == 4);
}

TEST_CASE("Figure: signals of unknown unit have a panel each") {
  const Figure figure = figure_of({{"a", "any", 1}, {"b", "any", 2}, {"n", "1", 3}}, "", "run.csv");
  REQUIRE(figure.panels.size() == 3);
  CHECK(figure.panels[1].label == "b");
  CHECK(figure.panels[2].label == "n");
}

TEST_CASE("Figure: quotes, back quotes and line ends in names stay text") {
  CHECK(gnuplot_quoted("it's `x`\n") == "'it''s `x` '");
}

TEST_CASE("Figure: gnuplot draws SVG and PNG, whatever the names, without leaving anything else") {
  const TemporaryFolder folder;
  write_file(folder / "a b'c.csv", "time,x,phi,y\n0,0,1,2\n1,3,4,5\n");
  const auto script = folder / "-a b'c.gp";
  write_file(script, gnuplot_script(figure_of(columns, "It's a `title`", "a b'c.csv"), "a b'c"));
  for (const std::string format : {"svg", "png"}) {
    const Drawing drawing = draw(script, folder / ("a b'c." + format), format);
    INFO(drawing.warning);
    CHECK(drawing.drawn);
  }
  CHECK(read_file(folder / "a b'c.png").substr(1, 3) == "PNG");
  const std::string svg = read_file(folder / "a b'c.svg");
  CHECK_THAT(
      svg, Catch::Contains("phi [rad]") && Catch::Contains("time [s]") && Catch::Contains("It's a `title`"));
  CHECK(folder.files() == 4);
}

TEST_CASE("Figure: a script that fails is a warning and leaves no figure") {
  const TemporaryFolder folder;
  write_file(folder / "bad.gp", "set output figure\nplot 'missing.csv'\n");
  const Drawing drawing = draw(folder / "bad.gp", folder / "bad.svg", "svg");
  CHECK_FALSE(drawing.drawn);
  CHECK_THAT(drawing.warning, Catch::Contains("gnuplot ended with status 1"));
  CHECK(folder.files() == 1);
}

TEST_CASE("Figure: a machine without gnuplot gets a warning that says what to install") {
  const TemporaryFolder folder;
  write_file(folder / "a.gp", "");
  const NoPrograms none;
  const Drawing drawing = draw(folder / "a.gp", folder / "a.svg", "svg");
  CHECK_FALSE(drawing.drawn);
  CHECK_THAT(drawing.warning, Catch::Contains("apt-get install gnuplot-nox"));
}
