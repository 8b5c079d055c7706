// The swarm of Coello, Pulido and Lechuga on problems whose fronts are known in closed form.
#include "studies/pareto/mopso.h"

#include <cmath>
#include <pagmo/algorithm.hpp>
#include <pagmo/algorithms/nspso.hpp>
#include <pagmo/problem.hpp>
#include <pagmo/problems/zdt.hpp>
#include <pagmo/utils/hypervolume.hpp>
#include <pagmo/utils/multi_objective.hpp>

#include "tests/catch.h"

namespace flyball::test {
namespace {

/// Schaffer's problem: x^2 and (x - 2)^2; its front is x from 0 to 2.
struct Schaffer {
  pagmo::vector_double fitness(const pagmo::vector_double& x) const {
    return {x[0] * x[0], (x[0] - 2.0) * (x[0] - 2.0)};
  }
  std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const { return {{-1000.0}, {1000.0}}; }
  pagmo::vector_double::size_type get_nobj() const { return 2; }
};

pagmo::population evolved(const pagmo::problem& problem, const Mopso& mopso, unsigned seed = 3) {
  return mopso.evolve(pagmo::population(problem, 50, seed));
}

double hypervolume(const pagmo::population& population, const pagmo::vector_double& reference) {
  std::vector<pagmo::vector_double> inside;
  for (const auto& f : population.get_f()) {
    if (pagmo::pareto_dominance(f, reference)) inside.push_back(f);
  }
  return inside.empty() ? 0.0 : pagmo::hypervolume(inside).compute(reference);
}

}  // namespace

TEST_CASE("MOPSO finds the front of Schaffer's problem") {
  const pagmo::problem problem{Schaffer{}};
  // Below f2 = (sqrt f1 - 2)^2, 0 <= f1 <= 4, towards (4, 4): 16 - 8/3. Fifty points with equal steps of f1
  // lose about half a step of each, 4/50 * 4/2 = 0.16; the fewer of an uneven front up to three times as
  // much.
  const double whole = 16.0 - 8.0 / 3.0;
  const double found = hypervolume(evolved(problem, Mopso(100, 7)), {4.0, 4.0});
  CHECK(found <= whole);
  CHECK(found >= whole - 0.5);
}

TEST_CASE("MOPSO finds the front of ZDT1 nearly as well as pagmo's swarm") {
  const pagmo::problem problem{pagmo::zdt(1, 10)};
  // Below f2 = 1 - sqrt f1, 0 <= f1 <= 1, towards (1.1, 1.1): 1.21 - 1/3. A cell of the grid is a tenth of
  // the front wide, and loses any of its points: gaps and ends cost up to a tenth.
  const double whole = 1.21 - 1.0 / 3.0;
  const pagmo::population last = evolved(problem, Mopso(400, 7));
  const double found = hypervolume(last, {1.1, 1.1});
  CHECK(found <= whole);
  CHECK(found >= whole - 0.1);
  const pagmo::population swarm =
      pagmo::algorithm(pagmo::nspso(200, 0.6, 2.0, 2.0, 1.0, 0.5, 2, "crowding distance", false, 7))
          .evolve(pagmo::population(problem, 52, 3));
  CHECK(found >= hypervolume(swarm, {1.1, 1.1}) - 0.06);
}

TEST_CASE("The archive of MOPSO comes out first, without a point that another one dominates") {
  const pagmo::population last = evolved(pagmo::problem{pagmo::zdt(1, 10)}, Mopso(100, 7));
  CHECK(std::get<0>(pagmo::fast_non_dominated_sorting(last.get_f()))[0].size() >= 40);
}

TEST_CASE("MOPSO stays within the bounds, and gives the same swarm for the same seed") {
  const pagmo::problem problem{pagmo::zdt(1, 10)};
  const pagmo::population one = evolved(problem, Mopso(20, 7)), other = evolved(problem, Mopso(20, 7));
  CHECK(one.get_x() == other.get_x());
  CHECK(one.get_x() != evolved(problem, Mopso(20, 8)).get_x());
  for (const auto& x : one.get_x()) {
    for (const double coordinate : x) CHECK((coordinate >= 0.0 && coordinate <= 1.0));
  }
}

TEST_CASE("MOPSO hands whole generations over when told how") {
  const pagmo::problem problem{Schaffer{}};
  int batches = 0;
  struct Batch {
    int* count;
    pagmo::vector_double operator()(const pagmo::problem& of, const pagmo::vector_double& decisions) const {
      ++*count;
      pagmo::vector_double all;
      for (const double x : decisions) {
        for (const double f : of.fitness({x})) all.push_back(f);
      }
      return all;
    }
  };
  Mopso mopso(20, 7);
  mopso.set_bfe(pagmo::bfe(Batch{&batches}));
  const pagmo::population together = evolved(problem, mopso);
  CHECK(batches == 20);
  CHECK(together.get_f() == evolved(problem, Mopso(20, 7)).get_f());
}

}  // namespace flyball::test
