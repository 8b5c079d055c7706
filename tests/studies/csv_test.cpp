#include "studies/csv.h"

#include <bit>
#include <charconv>
#include <cmath>
#include <limits>
#include <random>

#include "tests/catch.h"

using namespace flyball;

namespace {

Log log_of(const std::vector<std::string>& names, const std::vector<std::vector<double>>& rows) {
  Plan plan;
  for (const std::string& name : names) plan.columns.push_back({name, "m", 0});
  Log log(plan);
  for (const auto& row : rows) log.append_row(row);
  return log;
}

/// Any finite double: all exponents are equally likely, subnormal numbers and both zeros among them.
double random_double(std::mt19937_64& generator) {
  for (;;) {
    const auto x = std::bit_cast<double>(generator());
    if (std::isfinite(x)) return x;
  }
}

}  // namespace

TEST_CASE("CSV: a header with names, time first, and a row a record") {
  const Log log = log_of({"H", "robot.pose.x"}, {{0.0, 0.05, -1.0}, {0.1, 1e-300, 2.5}});
  CHECK(to_csv(log) == "time,H,robot.pose.x\n0,0.05,-1\n0.1,1e-300,2.5\n");
}

TEST_CASE("CSV: a log without signals or rows is a header") {
  CHECK(to_csv(log_of({"y"}, {})) == "time,y\n");
  CHECK(to_csv(log_of({}, {{1.5}})) == "time\n1.5\n");
}

TEST_CASE("CSV: every double reads back to the same bits") {
  std::mt19937_64 generator(1);
  std::vector<std::vector<double>> rows{
      {0.0, -0.0},
      {std::numeric_limits<double>::denorm_min(), -2.2250738585072014e-308},
      {std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()}};
  for (int k = 0; k < 50000; ++k) rows.push_back({random_double(generator), random_double(generator)});
  const std::string text = to_csv(log_of({"y"}, rows));

  const char* at = text.data() + text.find('\n') + 1;
  const char* const end = text.data() + text.size();
  long different = 0;
  for (const auto& row : rows) {
    for (const double x : row) {
      double read = 0.0;
      at = std::from_chars(at, end, read).ptr + 1;
      if (std::bit_cast<std::uint64_t>(read) != std::bit_cast<std::uint64_t>(x)) ++different;
    }
  }
  CHECK(different == 0);
  CHECK(at == end);
}
