#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tests/catch.h"
#include "tests/studies/fit_case.h"

using namespace flyball;
using namespace flyball::test;

namespace {

/// A problem of NIST's Statistical Reference Datasets for nonlinear regression, whose answers are certified
/// to 11 digits. The data are facts; https://www.itl.nist.gov/div898/strd/nls/nls_main.shtml
struct Regression {
  std::string name;
  std::string formula;                          // of t
  std::vector<std::pair<double, double>> data;  // t ascending, y
  std::vector<std::vector<double>> starts;      // NIST's, and from farther off
  std::vector<double> certified, errors;        // standard errors
  double squares;                               // residual sum of squares
  std::vector<double> upper = {};               // bounds from 0 on, and six starts, where one is not enough
};

const std::vector<Regression> regressions = {
    {"BoxBOD: exponential decay",
     "b1*(1 - exp(-b2*t))",
     {{1, 109}, {2, 149}, {3, 149}, {5, 191}, {7, 213}, {10, 224}},
     {{1.0, 1.0}, {100.0, 0.75}},
     {2.1380940889e2, 5.4723748542e-1},
     {1.2354515176e1, 1.0455993237e-1},
     1.1680088766e3,
     {1000.0, 10.0}},
    {"Misra1a: exponential decay",
     "b1*(1 - exp(-b2*t))",
     {{77.6, 10.07},
      {114.9, 14.73},
      {141.1, 17.94},
      {190.8, 23.93},
      {239.9, 29.61},
      {289.0, 35.18},
      {332.8, 40.02},
      {378.4, 44.82},
      {434.8, 50.76},
      {477.3, 55.05},
      {536.8, 61.01},
      {593.1, 66.40},
      {689.1, 75.47},
      {760.0, 81.78}},
     {{500.0, 0.0001}, {250.0, 0.0005}},
     {2.3894212918e2, 5.5015643181e-4},
     {2.7070075241, 7.2668688436e-6},
     1.2455138894e-1},
    {"DanWood: power",
     "b1*t^b2",
     {{1.309, 2.138}, {1.471, 3.421}, {1.490, 3.597}, {1.565, 4.340}, {1.611, 4.882}, {1.680, 5.660}},
     {{1.0, 5.0}, {0.7, 4.0}},
     {7.6886226176e-1, 3.8604055871},
     {1.8281973860e-2, 5.1726610913e-2},
     4.3173084083e-3},
    {"Rat42: sigmoid",
     "b1/(1 + exp(b2 - b3*t))",
     {{9, 8.93},
      {14, 10.8},
      {21, 18.59},
      {28, 22.33},
      {42, 39.35},
      {57, 56.11},
      {63, 61.73},
      {70, 64.62},
      {79, 67.08}},
     {{100.0, 1.0, 0.1}, {75.0, 2.5, 0.07}},
     {7.2462237576e1, 2.6180768402, 6.7359200066e-2},
     {1.7340283401, 8.8295217536e-2, 3.4465663377e-3},
     8.0565229338},
    {"MGH09: rational",
     "b1*(t^2 + t*b2)/(t^2 + t*b3 + b4)",
     {{0.0625, 0.0246},
      {0.0714, 0.0235},
      {0.0833, 0.0323},
      {0.1, 0.0342},
      {0.125, 0.0456},
      {0.167, 0.0627},
      {0.25, 0.0844},
      {0.5, 0.16},
      {1.0, 0.1735},
      {2.0, 0.1947},
      {4.0, 0.1957}},
     {{25.0, 39.0, 41.5, 39.0}, {0.25, 0.39, 0.415, 0.39}},
     {1.9280693458e-1, 1.9128232873e-1, 1.2305650693e-1, 1.3606233068e-1},
     {1.1435312227e-2, 1.9633220911e-1, 8.0842031232e-2, 9.0025542308e-2},
     3.0750560385e-4},
    {"Eckerle4: Gaussian peak",
     "b1/b2*exp(-0.5*((t - b3)/b2)^2)",
     {{400.0, 0.0001575}, {405.0, 0.0001699}, {410.0, 0.0002350}, {415.0, 0.0003102}, {420.0, 0.0004917},
      {425.0, 0.0008710}, {430.0, 0.0017418}, {435.0, 0.0046400}, {436.5, 0.0065895}, {438.0, 0.0097302},
      {439.5, 0.0149002}, {441.0, 0.0237310}, {442.5, 0.0401683}, {444.0, 0.0712559}, {445.5, 0.1264458},
      {447.0, 0.2073413}, {448.5, 0.2902366}, {450.0, 0.3445623}, {451.5, 0.3698049}, {453.0, 0.3668534},
      {454.5, 0.3106727}, {456.0, 0.2078154}, {457.5, 0.1164354}, {459.0, 0.0616764}, {460.5, 0.0337200},
      {462.0, 0.0194023}, {463.5, 0.0117831}, {465.0, 0.0074357}, {470.0, 0.0022732}, {475.0, 0.0008800},
      {480.0, 0.0004579}, {485.0, 0.0002345}, {490.0, 0.0001586}, {495.0, 0.0001143}, {500.0, 0.0000710}},
     {{1.0, 10.0, 500.0}, {1.5, 5.0, 450.0}},
     {1.5543827178, 4.0888321754, 4.5154121844e2},
     {1.5408051163e-2, 4.6803020753e-2, 4.6800518816e-2},
     1.4635887487e-3,
     {10.0, 50.0, 600.0}},
};

FitCase regression_case(const Regression& r, const std::vector<double>& start,
                        const TemporaryFolder& folder) {
  std::string parameters, csv = "time,y\n";
  for (std::size_t p = 0; p < start.size(); ++p) parameters += fmt::format("b{} = {:e}\n", p + 1, start[p]);
  for (const auto& [t, y] : r.data) csv += fmt::format("{},{}\n", t, y);
  write_file(folder / "data.csv", csv);
  FitCase c = fit_case(fmt::format(R"toml(
flyball = 1
[parameters]
{}
[blocks]
t = {{ type = "Clock" }}
y = {{ type = "Expression", inputs = ["t"], formula = "{}" }}
[diagram]
wires = ["t -> y"]
log = ["y"]
[simulation]
stop = {:e}
)toml",
                                   parameters, r.formula, r.data.back().first));
  c.fit.experiments.push_back({"data", folder / "data.csv", {{"y", "y", 1.0}}, {}});
  for (std::size_t p = 0; p < start.size(); ++p)
    c.fit.parameters.push_back(from(fmt::format("b{}", p + 1), start[p]));
  return c;
}

double relative(double found, double wanted) { return std::fabs(found / wanted - 1.0); }

}  // namespace

TEST_CASE("Fit: nonlinear regressions of NIST have their certified values, errors and sums") {
  for (const Regression& r : regressions) {
    for (const std::vector<double>& start : r.starts) {
      const TemporaryFolder folder;
      FitCase c = regression_case(r, start, folder);
      // From NIST's first starts of BoxBOD and Eckerle4, the way down leads to infinity.
      for (std::size_t p = 0; p < r.upper.size(); ++p) {
        c.fit.parameters[p].lower = 0.0;
        c.fit.parameters[p].upper = r.upper[p];
        c.fit.starts = 6;
      }
      const FitResult result = c.run();
      INFO(r.name << " from " << start[0] << ": " << result.reason << " after " << result.iterations);
      CHECK(result.converged);
      // Six digits are promised. Sums are of second order in the parameters, and so are better.
      CHECK(relative(2.0 * result.cost, r.squares) < 1e-9);
      for (std::size_t p = 0; p < start.size(); ++p) {
        INFO(result.parameters[p].name << " = " << result.parameters[p].value);
        CHECK(relative(result.parameters[p].value, r.certified[p]) < 1e-6);
        CHECK(relative(result.parameters[p].standard_error, r.errors[p]) < 1e-5);
      }
    }
  }
}
