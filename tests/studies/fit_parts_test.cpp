#include <Eigen/Dense>
#include <atomic>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "studies/fit/loss.h"
#include "studies/fit/quadratic_residuals.h"
#include "studies/fit/stencil.h"
#include "studies/parallel.h"
#include "tests/catch.h"

using namespace flyball;

TEST_CASE("Loss: slopes are derivatives of values, which are squares of small residuals") {
  for (const std::string& name : Loss::names()) {
    const Loss loss(name, 0.5);
    INFO(name);
    // Of second order in s/a^2 = 4e-8.
    CHECK(loss.value(1e-8) == Approx(1e-8).epsilon(1e-7));
    for (const double s : {0.01, 0.2, 0.3, 7.0}) {
      const double h = 1e-6 * s;
      // A central difference over 1e-6 has 1e-12 of curvature and 1e-10 of rounding.
      CHECK((loss.value(s + h) - loss.value(s - h)) / (2.0 * h) == Approx(loss.slope(s)).epsilon(1e-8));
      CHECK(loss.value(s) <= s);
    }
  }
  CHECK_THROWS_AS(Loss("huber", 0.0), std::invalid_argument);
}

TEST_CASE("Loss: weighted residuals have the cost and the gradient of the loss") {
  const Loss loss("cauchy", 0.5);
  const double r[] = {0.1, -2.0, 0.7}, jacobian[] = {1.0, 2.0, -3.0, 0.5, 0.2, 4.0};
  double weighted[] = {0.1, -2.0, 0.7}, rows[] = {1.0, 2.0, -3.0, 0.5, 0.2, 4.0};
  const double more = loss.apply(weighted, rows, 2);
  double wanted = 0.0, found = more * more, gradient[2] = {}, wanted_gradient[2] = {};
  for (int i = 0; i < 3; ++i) {
    wanted += loss.value(r[i] * r[i]);
    found += weighted[i] * weighted[i];
    for (int p = 0; p < 2; ++p) {
      gradient[p] += weighted[i] * rows[2 * i + p];
      wanted_gradient[p] += loss.slope(r[i] * r[i]) * r[i] * jacobian[2 * i + p];
    }
  }
  CHECK(found == Approx(wanted).epsilon(1e-14));
  for (int p = 0; p < 2; ++p) CHECK(gradient[p] == Approx(wanted_gradient[p]).epsilon(1e-14));
}

namespace {

/// Whether r and J say what they promise of a quantity.
void check_residuals(double value, const Eigen::VectorXd& gradient, const Eigen::MatrixXd& hessian,
                     const Eigen::MatrixXd& wanted) {
  const QuadraticResiduals q(value, gradient, hessian);
  CHECK(q.residuals.squaredNorm() == Approx(value).epsilon(1e-13));
  CHECK((q.jacobian.transpose() * q.residuals - 0.5 * gradient).norm() < 1e-13 * (1.0 + gradient.norm()));
  CHECK((q.jacobian.transpose() * q.jacobian - 0.5 * wanted).norm() < 1e-12 * (1.0 + wanted.norm()));
}

}  // namespace

TEST_CASE("A quantity as residuals: its value, its gradient, its curvature") {
  Eigen::MatrixXd hessian(2, 2);
  hessian << 4.0, 1.0, 1.0, 3.0;
  const Eigen::Vector2d gradient(0.5, -0.2);
  check_residuals(2.0, gradient, hessian, hessian);
  // Where the parabola promises less than 0, it is made steeper until it promises 0.
  const double drop = 0.5 * gradient.dot(hessian.inverse() * gradient);
  check_residuals(0.01, gradient, hessian, hessian * (drop / 0.01));
  // A saddle: curvature of the other sign counts as its magnitude.
  Eigen::MatrixXd saddle(2, 2);
  saddle << 4.0, 0.0, 0.0, -2.0;
  check_residuals(2.0, gradient, saddle, saddle.cwiseAbs());
  const QuadraticResiduals flat(0.0, Eigen::Vector2d::Zero(), Eigen::Matrix2d::Zero());
  CHECK(flat.residuals.norm() == 0.0);
  CHECK(flat.jacobian.allFinite());
}

namespace {

double parabola(const std::vector<double>& x) {
  return 1.0 + 2.0 * x[0] - x[1] + 3.0 * x[0] * x[0] + 0.5 * x[1] * x[1] - 2.0 * x[0] * x[1];
}

}  // namespace

TEST_CASE("Stencil: gradient and Hessian of a parabola, over the scales") {
  constexpr double all = std::numeric_limits<double>::infinity();
  std::vector<Unknown> unknowns = {{"a", "", 1.0, -all, all, 2.0}, {"b", "", 3.0, -all, all, 1.0}};
  const std::vector<double> at = {1.0, 3.0};
  const auto values = [&](const Stencil& stencil) {
    std::vector<double> result;
    for (const std::vector<double>& point : stencil.points()) result.push_back(parabola(point));
    return result;
  };
  const Stencil stencil(unknowns, at, Stencil::Order::hessian);
  const Eigen::VectorXd gradient = stencil.gradient(values(stencil));
  const Eigen::MatrixXd hessian = stencil.hessian(values(stencil));
  // Steps are 3e-4 and 9e-4: rounding of 1e-16 over their squares.
  CHECK(gradient[0] == Approx(2.0 * (2.0 + 6.0 - 6.0)).epsilon(1e-10));
  CHECK(std::fabs(gradient[1] - (-1.0 + 3.0 - 2.0)) < 1e-10);
  CHECK(hessian(0, 0) == Approx(4.0 * 6.0).epsilon(1e-7));
  CHECK(hessian(1, 1) == Approx(1.0).epsilon(1e-7));
  CHECK(hessian(0, 1) == Approx(2.0 * -2.0).epsilon(1e-7));
  CHECK(hessian(0, 1) == hessian(1, 0));

  // At a bound the difference has one side: exact but for half of the step times the curvature.
  unknowns[0].upper = 1.0;
  const Stencil bounded(unknowns, at, Stencil::Order::hessian);
  CHECK(bounded.points().size() == 5);
  CHECK(bounded.gradient(values(bounded))[0] == Approx(4.0).margin(2e-2));
  CHECK(bounded.hessian(values(bounded))(0, 0) == 0.0);
  CHECK(Stencil(unknowns, at, Stencil::Order::value).points().size() == 1);
}

TEST_CASE("Parallel: each number once, whatever the threads; a failure is passed on") {
  for (const int threads : {1, 2, 7}) {
    std::atomic<int> sum = 0, calls = 0;
    parallel_for(100, threads, [&](std::size_t k) {
      sum += static_cast<int>(k);
      ++calls;
    });
    CHECK(sum == 4950);
    CHECK(calls == 100);
    CHECK_THROWS_AS(parallel_for(10, threads,
                                 [](std::size_t k) {
                                   if (k == 3) throw std::runtime_error("three");
                                 }),
                    std::runtime_error);
  }
  parallel_for(0, 2, [](std::size_t) { FAIL("there is nothing to do"); });
}
