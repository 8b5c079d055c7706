// Files of values: what is read, and what is said about files that are wrong.
#include "models/language/csv.h"

#include <filesystem>
#include <fstream>

#include "models/diagram.h"
#include "tests/catch.h"
#include "tests/studies/temporary_folder.h"

using namespace flyball;

namespace {

using Problems = std::vector<std::string>;

Problems problems_of(const Diagnostics& diagnostics) {
  Problems problems;
  for (const Diagnostic& diagnostic : diagnostics.sorted()) problems.push_back(to_string(diagnostic));
  return problems;
}

CsvTable table_of(std::string_view text) {
  Diagnostics diagnostics("x.csv");
  const auto table = read_csv(text, diagnostics);
  CHECK(problems_of(diagnostics).empty());
  return table.value();
}

/// What is said about a text; nothing may be read then.
Problems refusal(std::string_view text) {
  Diagnostics diagnostics("x.csv");
  CHECK_FALSE(read_csv(text, diagnostics).has_value());
  return problems_of(diagnostics);
}

Problems series_refusal(std::string_view text, std::string_view column) {
  Diagnostics diagnostics("x.csv");
  CHECK(read_time_series(table_of(text), column, diagnostics) == nullptr);
  return problems_of(diagnostics);
}

}  // namespace

TEST_CASE("CSV: names, units and numbers, in the forms that programs write") {
  for (const char* text : {"time,v [m/s]\n0,1.5\n0.25,-2e3\n",               // our own results, and units
                           "\xEF\xBB\xBFtime,v [m/s]\r\n0,1.5\r\n.25,-2e3",  // a mark, CRLF, no end of line
                           " \"time\" , \"v [m/s]\"\n\"0\",1.5 \n\t0.25, \"-2e3\"\n"}) {
    INFO(text);
    const CsvTable table = table_of(text);
    REQUIRE(table.width() == 2);
    CHECK((table.columns[0].name == "time" && table.columns[0].unit.empty()));
    CHECK((table.columns[1].name == "v" && table.columns[1].unit == "m/s"));
    CHECK(table.numbers == std::vector{0.0, 1.5, 0.25, -2000.0});
    CHECK((table.rows() == 2 && table.at(1, 0) == 0.25 && table.find("v") == 1 && table.find("w") == -1));
  }
  CHECK(table_of("\"a \"\"b\"\", c\"\n1\n").columns[0].name == "a \"b\", c");
}

TEST_CASE("CSV: what is wrong stands at its line and column") {
  CHECK(refusal("") == Problems{"x.csv:1:1: error: expected a header of column names, found an empty file"});
  CHECK(refusal("t,y\n") ==
        Problems{"x.csv:2:1: error: expected a row of numbers after the header, found none"});
  CHECK(refusal("t,y\n0,1\n1,zwei\n2,\n3,0x10\n") ==
        Problems{"x.csv:3:3: error: expected a number, found \"zwei\"",
                 "x.csv:4:3: error: expected a number, found nothing",
                 "x.csv:5:3: error: expected a number, found \"0x10\""});
  CHECK(refusal("t,y\n0,nan\n1,-inf\n2,1e999\n") ==
        Problems{"x.csv:2:3: error: expected a finite number, found nan",
                 "x.csv:3:3: error: expected a finite number, found -inf",
                 "x.csv:4:3: error: expected a finite number, found 1e999"});
  CHECK(refusal("t,y\n0\n1,2,3,4\n\n2,3\n") ==
        Problems{"x.csv:2:2: error: expected 2 numbers, one for each column of the header, found 1",
                 "x.csv:3:5: error: expected 2 numbers, one for each column of the header, found 4",
                 "x.csv:4:1: error: expected 2 numbers, one for each column of the header, found 0"});
  CHECK(refusal("t,,t\n0,1,2\n") == Problems{"x.csv:1:3: error: expected the name of a column, found none",
                                             "x.csv:1:4: error: the column \"t\" stands twice"});
  CHECK(refusal("\"t,y\n0,1\n") == Problems{"x.csv:1:1: error: the quote is not closed on its line"});
  CHECK(refusal("t,y\n0,\"1\"2\n1,2\"\n") ==
        Problems{"x.csv:2:6: error: expected a comma or the end of the line after the quote",
                 "x.csv:3:4: error: a quote stands inside a field that does not begin with one"});
  CHECK(refusal(std::string_view("t,y\n0,1\0\n", 9)) ==
        Problems{"x.csv:2:4: error: the control character 0x00 is not taken"});
  // Columns count characters, not bytes.
  CHECK(refusal("t,größe,y x\n0,1,q\n") == Problems{"x.csv:2:5: error: expected a number, found \"q\""});
  CHECK(refusal("größe,größe\n0,1\n") == Problems{"x.csv:1:7: error: the column \"größe\" stands twice"});
}

TEST_CASE("CSV: units and bytes that are none") {
  CHECK_THAT(refusal("t,v [furlong]\n0,1\n").at(0),
             Catch::StartsWith("x.csv:1:6: error: ") && Catch::Contains("furlong"));
  CHECK_THAT(refusal("t,y\n0,\xFF\n").at(0), Catch::StartsWith("x.csv:2:1: error: "));
}

TEST_CASE("CSV: not more than ten errors") {
  std::string text = "t,y\n";
  for (int k = 0; k < 100; ++k) text += "a,b\n";
  CHECK(refusal(text).size() <= most_csv_errors + 1);
}

TEST_CASE("A time series is in SI, may jump, and never goes back in time") {
  Diagnostics diagnostics("x.csv");
  const auto series =
      read_time_series(table_of("t [ms],v [km/h],n\n0,36,1\n500,72,2\n500,0,3\n"), "v", diagnostics);
  REQUIRE(series != nullptr);
  CHECK(series->unit == "m/s");
  CHECK(series->times == std::vector{0.0, 0.5, 0.5});
  // A factor with one rounding.
  for (int k = 0; k < 3; ++k)
    CHECK(std::fabs(series->values[k] - std::vector{10.0, 20.0, 0.0}[k]) <= 20 * 0x1p-52);
  CHECK(read_time_series(table_of("t,y\n0,1\n"), "", diagnostics)->unit == "any");
  CHECK(series_refusal("t,y\n0,1\n2,1\n1.5,1\n", "y") ==
        Problems{"x.csv:4:1: error: time falls from 2 s to 1.5 s"});
  CHECK(series_refusal("t,speed,angle\n0,1,2\n", "sped") ==
        Problems{"x.csv:1:1: error: there is no column \"sped\"; did you mean \"speed\"?"});
  CHECK(series_refusal("t,a,b\n0,1,2\n", "") ==
        Problems{"x.csv:1:1: error: the file has several columns: name one of t, a, b"});
  CHECK(series_refusal("t\n0\n", "") ==
        Problems{"x.csv:1:1: error: expected a column of time and at least one more, separated by commas"});
  CHECK_THAT(series_refusal("t [m],y\n0,1\n", "y").at(0), Catch::StartsWith("x.csv:1:1: error: "));
}

TEST_CASE("A model says where a file of values is named, and what is wrong inside it") {
  const test::TemporaryFolder folder;
  const std::string model = (folder / "model.toml").string(), data = (folder / "data.csv").string();
  const auto said = [&](const std::string& block) {
    std::ofstream(model) << "flyball = 1\n[blocks]\nx = { type = \"FromFile\", " << block << " }\n";
    Diagnostics diagnostics(model);
    const auto diagram = read_diagram(diagnostics);
    if (diagram) CHECK(diagram->data_files.size() == 1);
    return problems_of(diagnostics);
  };
  std::ofstream(data) << "t,y\n0,1\n1,q\n";
  CHECK(said("file = \"data.csv\"") ==
        Problems{model + ":3:33: error: " + data + ":3:3: error: expected a number, found \"q\""});
  CHECK(said("file = \"date.csv\"") == Problems{model + ":3:33: error: " + (folder / "date.csv").string() +
                                                ": error: cannot be read: No such file or directory"});
  std::ofstream(data) << "t,y\n0,1\n1,2\n";
  CHECK(said("file = \"data.csv\"").empty());
  CHECK(said("column = \"x\", file = \"data.csv\"") ==
        Problems{model + ":3:35: error: " + data + ":1:1: error: there is no column \"x\"; known: t, y"});
}
