#include "studies/fit/objective.h"

#include <algorithm>
#include <cmath>

#include "studies/parallel.h"

namespace flyball {

Objective::Objective(std::vector<Unknown> unknowns, std::vector<ComparedRun> runs,
                     std::optional<Judgement> judgement, const Loss& loss, int threads)
    : unknowns_(std::move(unknowns)),
      runs_(std::move(runs)),
      judgement_(std::move(judgement)),
      loss_(loss),
      threads_(threads) {
  for (const ComparedRun& run : runs_) data_size_ += static_cast<int>(run.measured.values.size());
  residuals_.resize(static_cast<std::size_t>(size()));
  jacobian_.resize(residuals_.size() * unknowns_.size());
}

int Objective::size() const {
  const int more = loss_.squared() ? 0 : 1;
  return data_size_ + more + (judgement_ ? judgement_->size() : 0);
}

int Objective::simulations() const {
  int count = judgement_ ? judgement_->simulations() : 0;
  for (const ComparedRun& run : runs_) count += run.model.simulations();
  return count;
}

std::string Objective::gradient() const {
  const auto exact = std::ranges::count_if(runs_, [](const ComparedRun& run) { return run.model.exact(); });
  if (exact == 0) return "numeric";
  return judgement_ || exact < std::ssize(runs_) ? "mixed" : "exact";
}

std::vector<std::string> Objective::remarks() const {
  std::vector<std::string> all;
  for (const ComparedRun& run : runs_) {
    for (const std::string& remark : run.model.remarks()) {
      if (std::ranges::find(all, remark) == all.end()) all.push_back(remark);
    }
  }
  return all;
}

bool Objective::remembers(std::span<const double> scaled, bool derivatives) const {
  return has_residuals_ && (has_jacobian_ || !derivatives) && std::ranges::equal(scaled, scaled_);
}

bool Objective::evaluate(std::span<const double> scaled, double* residuals, double* jacobian) {
  const bool derivatives = jacobian != nullptr;
  if (!remembers(scaled, derivatives)) {
    scaled_.assign(scaled.begin(), scaled.end());
    parameters_.clear();
    for (std::size_t p = 0; p < scaled.size(); ++p) parameters_.push_back(scaled[p] * unknowns_[p].scale);
    has_residuals_ = has_jacobian_ = false;
    if (!compare_all(derivatives)) return false;
    has_jacobian_ = has_jacobian_ || derivatives;
    has_residuals_ = true;
  }
  std::ranges::copy(residuals_, residuals);
  if (derivatives) std::ranges::copy(jacobian_, jacobian);
  return true;
}

bool Objective::compare_all(bool derivatives) {
  std::vector<char> done(runs_.size(), 0);
  parallel_for(runs_.size(), threads_,
               [&](std::size_t k) { done[k] = runs_[k].model.run(parameters_, derivatives) ? 1 : 0; });
  if (const auto bad = std::ranges::find(done, 0); bad != done.end()) {
    failure_ = runs_[static_cast<std::size_t>(bad - done.begin())].model.failure();
    return false;
  }
  fill_data();
  if (!judgement_) return true;
  const std::size_t first = residuals_.size() - static_cast<std::size_t>(judgement_->size());
  if (judgement_->evaluate(parameters_, residuals_.data() + first,
                           derivatives ? jacobian_.data() + first * unknowns_.size() : nullptr))
    return true;
  failure_ = judgement_->failure();
  return false;
}

/// Exact derivatives come with the values, so they are kept, wanted or not: nearly every step that is tried
/// is taken, and its Jacobian asked for next.
void Objective::fill_data() {
  const std::size_t n = unknowns_.size();
  has_jacobian_ = !judgement_;
  std::size_t at = 0;
  for (const ComparedRun& run : runs_) {
    const std::vector<double>& values = run.model.values();
    const std::vector<double>& derivatives = run.model.derivatives();
    const bool differentiated = run.model.has_derivatives();
    has_jacobian_ = has_jacobian_ && differentiated;
    for (std::size_t i = 0; i < values.size(); ++i, ++at) {
      const double weight = run.weights[i % run.weights.size()];
      residuals_[at] = weight * (values[i] - run.measured.values[i]);
      for (std::size_t p = 0; differentiated && p < n; ++p)
        jacobian_[at * n + p] = weight * unknowns_[p].scale * derivatives[i * n + p];
    }
  }
  if (loss_.squared()) return;
  residuals_[at] = loss_.apply({residuals_.data(), at}, jacobian_.data(), n);
  std::fill_n(jacobian_.begin() + static_cast<std::ptrdiff_t>(at * n), n, 0.0);
}

}  // namespace flyball
