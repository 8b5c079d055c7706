#include "solvers/algebraic_loop.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "solvers/bad_value.h"
#include "solvers/errors.h"
#include "solvers/kinsol.h"
#include "solvers/workspace.h"

namespace flyball {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr int most_iterations = 40;

/// The numbers of one loop, by tear.
struct Solution {
  Eigen::VectorXd start, guess, found, scaled, step;
  Eigen::MatrixXd jacobian;  // of found - guess by guess, its rows over `row_scale`
  Eigen::VectorXd row_scale;
  Eigen::PartialPivLU<Eigen::MatrixXd> factors;
  bool factored = false;
  bool known = false;  // it was solved before
  double floor = 0.0;  // relative residual below which rounding let no Newton step lead
  std::vector<Jet> jet_guess, jet_found;
  Kinsol kinsol;
};

}  // namespace

struct LoopMemory::Numbers {
  std::vector<Solution> solutions;  // of each loop
  // Room for loops on other numbers than those of the frame, by slot.
  std::vector<double> values;
  std::vector<Jet> jets;
};

LoopMemory::LoopMemory() = default;
LoopMemory::~LoopMemory() = default;
LoopMemory::LoopMemory(LoopMemory&&) noexcept = default;
LoopMemory& LoopMemory::operator=(LoopMemory&&) noexcept = default;
LoopMemory::LoopMemory(const LoopMemory& other)
    : numbers_(other.numbers_ ? std::make_unique<Numbers>(*other.numbers_) : nullptr) {}
LoopMemory& LoopMemory::operator=(const LoopMemory& other) {
  if (this != &other) numbers_ = other.numbers_ ? std::make_unique<Numbers>(*other.numbers_) : nullptr;
  return *this;
}

LoopMemory::Numbers& LoopMemory::numbers(const Plan& plan) {
  if (numbers_) return *numbers_;
  numbers_ = std::make_unique<Numbers>();
  numbers_->solutions.resize(plan.loops.size());
  numbers_->values.resize(plan.layout.size);
  numbers_->jets.resize(plan.layout.size);
  for (std::size_t k = 0; k < plan.loops.size(); ++k) {
    Solution& of = numbers_->solutions[k];
    const auto n = static_cast<Eigen::Index>(plan.loops[k].tears.size());
    of.start = of.guess = of.found = of.scaled = of.step = of.row_scale = Eigen::VectorXd::Zero(n);
    of.jacobian = Eigen::MatrixXd::Zero(n, n);
    of.factors = Eigen::PartialPivLU<Eigen::MatrixXd>(n);
    of.jet_guess.resize(n);
    of.jet_found.resize(n);
  }
  return *numbers_;
}

namespace {

bool runs(int rate, const LoopCall& call) {
  return rate < 0 || (call.hits != nullptr && (*call.hits)[rate] != 0);
}

const Loop& loop_of(const LoopCall& call) { return call.plan.loops[call.span.loop]; }

/// Goes through the calls of a loop with its tears at `guess`; `found` is what they give for them. Tears that
/// stand still are left out.
template <class T, class Numbers, class Visit>
void once_round(const LoopCall& call, const Frame<T>& frame, const Numbers& guess, Numbers& found,
                Visit visit) {
  const Loop& loop = loop_of(call);
  for (std::size_t k = 0; k < loop.tears.size(); ++k) {
    frame.values[loop.tears[k].slot] = guess[k];
    found[k] = guess[k];
  }
  auto back = loop.returns.begin();
  for (int at = call.span.first; at < call.span.last; ++at) {
    const Op& op = call.program.ops[at];
    const bool hit = runs(op.rate, call);
    if (hit) visit(op);
    for (; back != loop.returns.end() && back->op == at - call.span.first; ++back) {
      T& value = frame.values[loop.tears[back->tear].slot];
      if (hit && back->final) found[back->tear] = value;
      value = guess[back->tear];
    }
  }
}

template <class T, class Numbers>
void once_round(const LoopCall& call, const Frame<T>& frame, const Numbers& guess, Numbers& found) {
  once_round(call, frame, guess, found, [&](const Op& op) { flyball::call(op, call.plan, frame); });
}

/// The arrays of a frame, with other values.
template <class To, class From>
Frame<To> with_values(const Frame<From>& from, std::vector<To>& values) {
  Frame<To> to;
  to.values = values.data();
  to.bits = from.bits;
  to.first_state = from.first_state;
  to.first_relation = from.first_relation;
  to.objects = from.objects;
  to.next_objects = from.next_objects;
  to.memories = from.memories;
  return to;
}

class LoopSolver {
 public:
  LoopSolver(const LoopCall& call, const Frame<double>& frame, LoopMemory::Numbers& numbers)
      : call_(call),
        loop_(loop_of(call)),
        frame_(frame),
        jets_(numbers.jets),
        of_(numbers.solutions[call.span.loop]) {}

  void solve() {
    find();
    if (of_.known) return;
    of_.known = true;
    if (!factor()) throw_singular();
    if (call_.hits != nullptr && !loop_.affine && !loop_.guessed) look_for_others();
  }

  /// Factors of the Jacobian at the solution.
  void differentiate() {
    if (!factor()) throw_singular();
  }

 private:
  enum class Outcome { solved, singular, lost };

  void find() {
    for (std::size_t k = 0; k < loop_.tears.size(); ++k) of_.guess[k] = frame_.values[loop_.tears[k].slot];
    of_.start = of_.guess;
    evaluate();
    if (!of_.found.allFinite()) name_bad_value();
    switch (newton()) {
      case Outcome::solved:
        return;
      case Outcome::singular:
        return from_other_guesses();
      case Outcome::lost:
        return search();
    }
  }

  void evaluate() { once_round(call_, frame_, of_.guess, of_.found); }

  /// The greatest difference between a tear and what it gives, relative to `scale(k)`.
  template <class Scale>
  double residual(Scale scale) const {
    double greatest = 0.0;
    for (Eigen::Index k = 0; k < of_.guess.size(); ++k) {
      const double difference = std::fabs(of_.found[k] - of_.guess[k]);
      if (difference != 0.0) greatest = std::max(greatest, difference / scale(k));
      if (difference != difference) return difference;
    }
    return greatest;
  }
  double relative() const {
    return residual([&](auto k) { return std::max(std::fabs(of_.guess[k]), std::fabs(of_.found[k])); });
  }
  bool meets_tolerance() const {
    return residual([&](auto k) { return std::max(1.0, std::fabs(of_.guess[k])); }) <= loop_tolerance;
  }

  /// Newton's method; the factors of before serve as long as a step with them takes off 95 %, which those of
  /// an affine loop always do. It goes on to rounding: methods of high order would feel the tolerance.
  Outcome newton() {
    double before = std::numeric_limits<double>::infinity();
    bool is_new = false;  // the factors belong to the point before the last step
    for (int k = 0; k < most_iterations; ++k) {
      const double now = relative();
      if (!std::isfinite(now)) return Outcome::lost;
      if (now <= std::max(4.0 * eps, 4.0 * of_.floor) && meets_tolerance()) return Outcome::solved;
      if (is_new && now > 0.5 * before && meets_tolerance()) {
        // What is left is rounding. Next to 0 that says nothing about the loop elsewhere.
        if (now < 1e-9) of_.floor = now;
        return Outcome::solved;
      }
      const bool renew = !of_.factored || now > 0.05 * before;
      if (renew && !factor()) return Outcome::singular;
      is_new = renew;
      before = now;
      take_step();
    }
    return Outcome::lost;
  }

  void take_step() {
    of_.scaled = (of_.found - of_.guess).cwiseQuotient(of_.row_scale);
    of_.step = of_.factors.solve(of_.scaled);
    of_.guess -= of_.step;
    evaluate();
  }

  /// False where the Jacobian is singular, or not finite.
  bool factor() {
    of_.factored = false;
    if (!differentiate_at(of_.guess.data(), of_.jacobian.data())) return false;
    const Eigen::Index n = of_.guess.size();
    for (Eigen::Index k = 0; k < n; ++k) {
      // The diagonal is a difference from 1: what is left of it is measured against that.
      of_.row_scale[k] = std::max(1.0, of_.jacobian.row(k).cwiseAbs().maxCoeff());
      of_.jacobian.row(k) /= of_.row_scale[k];
    }
    of_.factors.compute(of_.jacobian);
    const double least = of_.factors.matrixLU().diagonal().cwiseAbs().minCoeff();
    of_.factored = least > 16.0 * eps * static_cast<double>(n);
    return of_.factored;
  }

  /// The derivative of found - guess by guess, by columns. False where it is not finite.
  bool differentiate_at(const double* guess, double* columns) {
    const auto n = static_cast<int>(loop_.tears.size());
    const Frame<Jet> frame = with_values(frame_, jets_);
    for (const int slot : loop_.slots) jets_[slot] = Jet(frame_.values[slot]);
    bool finite = true;
    for (int first = 0; first < n; first += Jet::DIMENSION) {
      const int last = std::min(n, first + Jet::DIMENSION);
      for (int k = 0; k < n; ++k) {
        of_.jet_guess[k] = Jet(guess[k]);
        if (k >= first && k < last) of_.jet_guess[k].v[k - first] = 1.0;
      }
      once_round(call_, frame, of_.jet_guess, of_.jet_found);
      for (int c = first; c < last; ++c) {
        for (int r = 0; r < n; ++r) {
          const bool still = !runs(loop_.tears[r].rate, call_);
          const double slope = still ? 0.0 : of_.jet_found[r].v[c - first];
          columns[c * n + r] = slope - (r == c ? 1.0 : 0.0);
          finite = finite && std::isfinite(slope);
        }
      }
    }
    return finite;
  }

  /// At the start nobody has said which solution is meant, so there had better be one only.
  void look_for_others() {
    const Eigen::VectorXd first = of_.guess;
    for (const double distance : {1.0, -1.0, 10.0, -10.0}) {
      for (Eigen::Index k = 0; k < first.size(); ++k) {
        of_.guess[k] = first[k] + distance * (1.0 + std::fabs(first[k]));
      }
      of_.factored = false;
      evaluate();
      if (newton() != Outcome::solved) continue;
      for (Eigen::Index k = 0; k < first.size(); ++k) {
        if (std::fabs(of_.guess[k] - first[k]) > 1e-6 * (1.0 + std::fabs(first[k])))
          throw_several(k, first[k]);
      }
    }
    of_.guess = first;
    of_.factored = false;
    of_.floor = 0.0;
    evaluate();
  }

  /// A Jacobian may be singular at a guess without being so at a solution.
  void from_other_guesses() {
    if (meets_tolerance() || loop_.affine) throw_singular();
    for (const double distance : {0.1, -0.3, 1.0}) {
      for (Eigen::Index k = 0; k < of_.guess.size(); ++k) {
        of_.guess[k] = of_.start[k] + distance * (1.0 + std::fabs(of_.start[k]));
      }
      evaluate();
      if (newton() == Outcome::solved) return;
    }
    search();
  }

  /// With a line search, from where the tears were.
  void search() {
    const Eigen::Index n = of_.guess.size();
    Equations equations;
    equations.residual = [this](const double* z, double* f) {
      std::copy_n(z, of_.guess.size(), of_.guess.data());
      evaluate();
      for (Eigen::Index k = 0; k < of_.guess.size(); ++k) f[k] = of_.found[k] - of_.guess[k];
      return of_.found.allFinite();
    };
    equations.jacobian = [this](const double* z, double* columns) { return differentiate_at(z, columns); };
    of_.factored = false;
    of_.step = of_.start;
    of_.kinsol.solve(static_cast<int>(n), equations, 0.1 * loop_tolerance, of_.step.data());
    of_.guess = of_.step;
    evaluate();
    const Outcome outcome = newton();
    if (outcome == Outcome::singular && meets_tolerance()) throw_singular();
    if (outcome != Outcome::solved) throw_lost();
  }

  std::string tear_name() const { return call_.plan.slot_name(loop_.tears.front().slot); }

  [[noreturn]] void fail(const std::string& what) const {
    throw SimulationError(
        SimulationError::Kind::algebraic_loop, frame_.values[0],
        fmt::format("algebraic loop at t = {} s: {}: {}; an Integrator, a strictly proper TransferFcn or a "
                    "UnitDelay anywhere in the chain breaks it",
                    frame_.values[0], what, call_.plan.chains[loop_.chain].text));
  }

  [[noreturn]] void throw_singular() const {
    if (meets_tolerance()) fail(fmt::format("several solutions, {} is one of many", tear_name()));
    fail(fmt::format("no solution, {} needs to differ from itself", tear_name()));
  }

  [[noreturn]] void throw_several(Eigen::Index tear, double other) const {
    const std::string name = call_.plan.slot_name(loop_.tears[tear].slot);
    fail(fmt::format(
        "several solutions, {} may be {:.6g} or {:.6g}: give guesses = [{{ port = \"{}\", value = "
        "… }}] in [diagram]",
        name, other, of_.guess[tear], name));
  }

  [[noreturn]] void throw_lost() const {
    fail(fmt::format("no solution found from {} = {}", tear_name(), of_.start[0]));
  }

  [[noreturn]] void name_bad_value() {
    once_round(call_, frame_, of_.start, of_.found, [&](const Op& op) {
      for (int k = 0; k < op.count; ++k) check_call(op, k, call_.plan, frame_);
    });
    throw_lost();
  }

  const LoopCall& call_;
  const Loop& loop_;
  const Frame<double>& frame_;
  std::vector<Jet>& jets_;
  Solution& of_;
};

}  // namespace

void solve_loop(const LoopCall& call, const Frame<double>& frame, LoopMemory& memory) {
  LoopSolver(call, frame, memory.numbers(call.plan)).solve();
}

void solve_loop(const LoopCall& call, const Frame<Jet>& frame, LoopMemory& memory) {
  const Loop& loop = loop_of(call);
  LoopMemory::Numbers& numbers = memory.numbers(call.plan);
  Solution& of = numbers.solutions[call.span.loop];
  for (const int slot : loop.slots) numbers.values[slot] = frame.values[slot].a;
  numbers.values[0] = frame.values[0].a;
  const Frame<double> on_double = with_values(frame, numbers.values);
  LoopSolver solver(call, on_double, numbers);
  solver.solve();
  solver.differentiate();
  const std::size_t n = loop.tears.size();
  for (std::size_t k = 0; k < n; ++k) {
    const bool still = !runs(loop.tears[k].rate, call);
    of.jet_guess[k] = still ? frame.values[loop.tears[k].slot] : Jet(of.guess[k]);
  }
  once_round(call, frame, of.jet_guess, of.jet_found);
  for (int direction = 0; direction < Jet::DIMENSION; ++direction) {
    for (std::size_t k = 0; k < n; ++k) {
      const bool still = !runs(loop.tears[k].rate, call);
      of.scaled[k] = still ? 0.0 : -of.jet_found[k].v[direction] / of.row_scale[k];
    }
    of.step = of.factors.solve(of.scaled);
    for (std::size_t k = 0; k < n; ++k) {
      if (runs(loop.tears[k].rate, call)) of.jet_guess[k].v[direction] = of.step[k];
    }
  }
  once_round(call, frame, of.jet_guess, of.jet_found);
}

}  // namespace flyball
