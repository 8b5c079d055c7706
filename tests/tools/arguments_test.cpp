#include <string>

#include "studies/quantity_text.h"
#include "tests/catch.h"
#include "tools/commands.h"
#include "tools/progress_bar.h"

using namespace flyball;

TEST_CASE("Arguments: times are numbers or expressions with units") {
  CHECK(parse_positive("2.5", "s") == 2.5);
  CHECK(parse_positive("250 ms", "s") == 0.25);
  CHECK(parse_positive("2*5 s", "s") == 10.0);
  CHECK(parse_positive_exact("1/3 s", "s") == *Rational::fraction(1, 3));
}

TEST_CASE("Arguments: what is no positive time is refused with the reason") {
  CHECK_THROWS_WITH(parse_positive("0", "s"), "\"0\": expected a value above 0 s, found 0");
  CHECK_THROWS_AS(parse_positive("-1 s", "s"), std::invalid_argument);
  CHECK_THROWS_AS(parse_positive("1/0", "s"), std::invalid_argument);
  CHECK_THROWS_AS(parse_positive("", "s"), std::invalid_argument);
  CHECK_THROWS_WITH(parse_positive("3 m", "s"), Catch::StartsWith("\"3 m\": "));
  CHECK_THROWS_WITH(parse_positive("3 +", "s"), Catch::Contains("at character"));
  CHECK_THROWS_WITH(parse_positive_exact("pi", "s"), Catch::Contains("exact value"));
}

TEST_CASE("Progress bar: how far, and how long still") {
  CHECK(ProgressBar::line(0.0, 0.0) == "[--------------------------------]   0 %");
  CHECK(ProgressBar::line(0.25, 30.0) == "[########------------------------]  25 %  1:30 left");
  // A quarter of the work was there before.
  CHECK(ProgressBar::line(0.5, 10.0, 0.25) == "[################----------------]  50 %  0:20 left");
  CHECK(ProgressBar::line(1.0, 8.0) == "[################################] 100 %  0:00 left");
  CHECK(ProgressBar::line(1e-9, 10.0) == "[--------------------------------]   0 %  1440:00 left");
}
