#include <cmath>
#include <map>

#include "tests/source_dir.h"
#include "tests/systems/harness.h"

using namespace flyball;
using namespace flyball::test;

namespace {

/// The solution at the stop time, by logged signal.
using Reference = std::map<std::string, double>;

struct Problem {
  std::string model;
  std::vector<std::string> methods;
  Reference solution;
};

double curtiss_hirschfelder(double k, double t) {
  return k * (k * std::cos(t) + std::sin(t)) / (k * k + 1.0);  // exp(-k t) is 0
}

// Closed forms; the Test Set for Initial Value Problem Solvers (van der Pol, HIRES, Oregonator, Akzo Nobel);
// the tables of Hull and others (populations, rigid body, torus); the others agree with two methods at 1e-12.
const std::vector<Problem> problems = {
    {"ivp/populations", {"dp5"}, {{"prey", 0.6761876008576}, {"hunter", 0.1860816099640}}},
    {"ivp/rigid_body", {"dp5"}, {{"a", -0.9396570798729}, {"b", -0.3421177754001}, {"c", 0.7414126596200}}},
    {"ivp/torus", {"dp5"}, {{"x", 0.9826950928006}, {"y", 2.1984470816948}, {"z", 0.9129452507276}}},
    {"ivp/brusselator", {"dp5", "bdf"}, {{"u", 0.4986370712683}, {"v", 4.5967803494520}}},
    {"ivp/bessel", {"dp5", "bdf"}, {{"y", std::sqrt(2.0 / (std::acos(-1.0) * 21.0)) * std::sin(21.0)}}},
    {"ivp/curtiss_hirschfelder", {"bdf"}, {{"y", curtiss_hirschfelder(2000.0, 10.0)}}},
    {"ivp/kaps", {"bdf"}, {{"x", std::exp(-4.0)}, {"y", std::exp(-2.0)}}},
    {"ivp/oregonator",
     {"bdf"},
     {{"a", 1.000814870318523}, {"b", 1228.178521549917}, {"c", 132.0554942846706}}},
    {"ivp/hires",
     {"bdf"},
     {{"y1", 0.7371312573325668e-3},
      {"y2", 0.1442485726316185e-3},
      {"y3", 0.5888729740967575e-4},
      {"y4", 0.1175651343283149e-2},
      {"y5", 0.2386356198831331e-2},
      {"y6", 0.6238968252742796e-2},
      {"y7", 0.2849998395185769e-2},
      {"y8", 0.2850001604814231e-2}}},
    {"ivp/akzo",
     {"bdf"},
     {{"y1", 0.1150794920661702},
      {"y2", 0.1203831471567715e-2},
      {"y3", 0.1611562887407974},
      {"y4", 0.3656156421249283e-3},
      {"y5", 0.1708010885264404e-1}}},
    {"classic/robertson",
     {"bdf"},
     {{"A", 0.7158270687194}, {"B", 0.9185534764557e-5}, {"C", 0.2841637457458}}},
    {"classic/van_der_pol_stiff", {"bdf"}, {{"x", 1.706167732170483}}},
};

/// Significant correct digits at the stop time of the worst signal; atol goes with rtol as in the file.
double correct_digits(const Problem& problem, const std::string& method, double rtol) {
  Model model = load_model(source_dir() + "/models/" + problem.model + ".toml");
  model.settings.method = method;
  model.settings.atol *= rtol / model.settings.rtol;
  model.settings.rtol = rtol;
  Run run(model);
  run.finish();
  double worst = 1e-16;
  for (const auto& [signal, exact] : problem.solution)
    worst = std::max(worst, std::fabs(run.column(signal).back() - exact) / std::fabs(exact));
  return -std::log10(worst);
}

}  // namespace

TEST_CASE("Problems of the literature: correct digits follow the tolerance") {
  for (const Problem& problem : problems) {
    for (const std::string& method : problem.methods) {
      double before = 0.0;
      for (const double rtol : {1e-4, 1e-6, 1e-8}) {
        const double digits = correct_digits(problem, method, rtol);
        INFO(problem.model << " with " << method << " at " << rtol << ": " << digits << " digits");
        // Errors add up over some hundred steps: two digits, the margin that the tolerance is given.
        CHECK(digits >= -std::log10(rtol) - 2.0);
        CHECK(digits > before);
        before = digits;
      }
    }
  }
}

TEST_CASE("Problems of the literature: auto keeps to the tolerance, too") {
  for (const Problem& problem : problems) {
    INFO(problem.model);
    CHECK(correct_digits(problem, "auto", 1e-6) >= 4.0);
  }
}

TEST_CASE("Problems of the literature: a tight run confirms the published digits") {
  for (const Problem& problem : problems) {
    const std::string method = problem.methods.front() == "dp5" ? "adams" : "bdf";
    INFO(problem.model << " with " << method);
    // Of 1e-12, some ten thousand steps leave a few 1e-10.
    CHECK(correct_digits(problem, method, 1e-12) > 9.0);
  }
}
