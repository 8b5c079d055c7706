#include "benchmarks/chain.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "benchmarks/dopri5.h"
#include "benchmarks/flyball_run.h"

namespace flyball::bench {
namespace {

class ChainDopri5 {
 public:
  ChainDopri5(const Chain& chain, double rtol, double atol)
      : k_(chain.k.data()), n_(chain.size()), rtol_(rtol), atol_(atol), rows_(9 * chain.k.size()) {
    chain.rates(row(before_), row(first_));
  }

  std::vector<double> solve() {
    dopri5::Controller controller;
    double t = 0.0, size = 1e-4;
    while (t < Chain::stop) {
      const bool lands = Chain::stop - t <= 1.01 * size;
      const double taken = lands ? Chain::stop - t : size;
      const double error = attempt(taken);
      if (!(error <= 1.0)) {
        size = controller.after_rejected(taken, error);
        rejected_ = true;
        continue;
      }
      size = controller.after_accepted(taken, error, rejected_);
      rejected_ = false;
      t = lands ? Chain::stop : t + taken;
      swap_ends();
    }
    return {row(before_), row(before_) + n_};
  }

 private:
  double* row(int r) { return rows_.data() + static_cast<std::ptrdiff_t>(r) * n_; }

  double attempt(double size) {
    stage<1>(size);
    stage<2>(size);
    stage<3>(size);
    stage<4>(size);
    stage<5>(size);
    stage<6>(size);
    return error(size);
  }

  /// State and rates of a stage in one pass: the state is only kept of the last.
  template <int s>
  void stage(double size) {
    const double *x = row(before_), *k0 = row(first_), *k1 = row(1), *k2 = row(2), *k3 = row(3), *k4 = row(4),
                 *k5 = row(5);
    constexpr const double* a = dopri5::a[s];
    const auto state = [=](int i) {
      double sum = a[0] * k0[i];
      if constexpr (s > 1 && s < 6) sum += a[1] * k1[i];
      if constexpr (s > 2) sum += a[2] * k2[i];
      if constexpr (s > 3) sum += a[3] * k3[i];
      if constexpr (s > 4) sum += a[4] * k4[i];
      if constexpr (s > 5) sum += a[5] * k5[i];
      return x[i] + size * sum;
    };
    double* __restrict__ rates = row(s < 6 ? s : last_);
    double* __restrict__ states = row(after_);
    double left = 1.0, middle = state(0);
    for (int i = 0; i + 1 < n_; ++i) {
      const double right = state(i + 1);
      if constexpr (s == 6) states[i] = middle;
      rates[i] = k_[i] * (left - 2.0 * middle + right);
      left = middle;
      middle = right;
    }
    if constexpr (s == 6) states[n_ - 1] = middle;
    rates[n_ - 1] = k_[n_ - 1] * (left - 2.0 * middle);
  }

  double error(double size) {
    const double *x0 = row(before_), *x1 = row(after_), *k0 = row(first_), *k2 = row(2), *k3 = row(3),
                 *k4 = row(4), *k5 = row(5), *k6 = row(last_);
    const double* e = dopri5::e;
    double sum = 0.0;
    for (int i = 0; i < n_; ++i) {
      const double difference =
          e[0] * k0[i] + e[2] * k2[i] + e[3] * k3[i] + e[4] * k4[i] + e[5] * k5[i] + e[6] * k6[i];
      const double weighted =
          size * difference / (atol_ + rtol_ * std::max(std::fabs(x0[i]), std::fabs(x1[i])));
      sum += weighted * weighted;
    }
    return sum / n_;
  }

  void swap_ends() {
    std::swap(before_, after_);
    std::swap(first_, last_);
  }

  const double* k_;
  int n_;
  double rtol_, atol_;
  bool rejected_ = false;
  int before_ = 8, after_ = 7, first_ = 6, last_ = 0;
  std::vector<double> rows_;
};

using Solve = std::vector<double> (*)(const Chain&, double, double);

Contender twin(int sections, double stiffness, Solve solve, double rtol, double atol) {
  auto chain = std::make_shared<const Chain>(sections, stiffness);
  auto last = std::make_shared<std::vector<double>>();
  Contender result;
  result.run = [=] { *last = solve(*chain, rtol, atol); };
  result.result = [=] { return *last; };
  return result;
}

std::vector<double> states(const Simulator& simulator) {
  const std::vector<double>& values = simulator.workspace().values;
  const Layout& layout = simulator.plan().layout;
  return {values.begin() + layout.first_state, values.begin() + layout.first_held};
}

Workload workload(int sections, bool stiff) {
  Workload w;
  w.name = fmt::format("W4{} chain, N = {}", stiff ? 's' : 'n', sections);
  w.must = stiff ? 1.5 : 3.0;
  w.aim = stiff ? 1.1 : 1.5;
  w.sections = sections;
  const double stiffness = stiff ? 1e5 : 25.0;
  const Solve solve = stiff ? solve_chain_bdf : solve_chain_dopri5;
  w.twin = [=](double rtol, double atol) { return twin(sections, stiffness, solve, rtol, atol); };
  w.ours = [=, model = std::make_shared<Model>()](double rtol, double atol) {
    if (!model->plan) {
      model->plan = plan_of("chain", generate_chain(fmt::format("{} {}", stiff ? "--stiff" : "", sections)));
      model->settings = model->plan->diagram->simulation;
      model->log.enabled = false;
    }
    return contender(*model, rtol, atol, states);
  };
  return w;
}

}  // namespace

Chain::Chain(int sections, double stiffness) {
  for (int i = 1; i <= sections; ++i) k.push_back(stiffness * (1.0 + 0.5 * std::sin(i)));
}

void Chain::rates(const double* x, double* dx) const {
  const int last = size() - 1;
  double left = 1.0;
  for (int i = 0; i < last; ++i) {
    dx[i] = k[i] * (left - 2.0 * x[i] + x[i + 1]);
    left = x[i];
  }
  dx[last] = k[last] * (left - 2.0 * x[last]);
}

std::vector<double> solve_chain_dopri5(const Chain& chain, double rtol, double atol) {
  return ChainDopri5(chain, rtol, atol).solve();
}

void add_chain(std::vector<Workload>& workloads) {
  for (const int sections : {10, 100, 1000, 10000}) workloads.push_back(workload(sections, false));
  for (const int sections : {1000, 10000}) workloads.push_back(workload(sections, true));
}

}  // namespace flyball::bench
