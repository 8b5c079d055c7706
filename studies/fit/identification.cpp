#include "studies/fit/identification.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace flyball {
namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();
/// Columns of the Jacobian, scaled by parameters, that are this much shorter than the longest are noise.
constexpr double no_influence = 1e-9;
/// A direction of parameters along which residuals change this much less than along others is not told:
/// derivatives are not more exact than that, or as differences.
constexpr double not_told_exactly = 1e-8, not_told_by_differences = 1e-5;
constexpr double strongly_correlated = 0.99;

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The parameters that the data can tell something of, and their part of the Jacobian.
class Identification {
 public:
  Identification(const DataFit& fit, FitResult& result);
  void run();

 private:
  void choose_columns();
  void decompose();
  void fill_errors();
  void name_untold_direction();
  void name_pairs();
  void name_large_errors();
  void remark(std::string text) { result_.remarks.push_back(std::move(text)); }
  const std::string& name(int k) const { return result_.parameters[chosen_[k]].name; }

  const DataFit& fit_;
  FitResult& result_;
  int all_, rows_;
  Eigen::Map<const RowMajor> jacobian_;
  std::vector<int> chosen_;  // numbers of parameters
  Eigen::VectorXd lengths_;  // of the chosen columns
  Eigen::MatrixXd inverse_;  // of J'J, columns of length 1
  Eigen::VectorXd weakest_;  // direction of parameters
  bool untold_ = false;
};

Identification::Identification(const DataFit& fit, FitResult& result)
    : fit_(fit),
      result_(result),
      all_(static_cast<int>(result.parameters.size())),
      rows_(static_cast<int>(fit.residuals.size())),
      jacobian_(fit.jacobian.data(), rows_, all_) {}

void Identification::choose_columns() {
  double longest = 0.0;
  for (int p = 0; p < all_; ++p) longest = std::max(longest, jacobian_.col(p).norm());
  std::vector<double> lengths;
  for (int p = 0; p < all_; ++p) {
    const double length = jacobian_.col(p).norm();
    if (length <= no_influence * longest) {
      remark(fmt::format("{} has no influence on the data; fix it, or match a signal that it moves",
                         result_.parameters[p].name));
    } else if (!result_.parameters[p].at_bound) {
      chosen_.push_back(p);
      lengths.push_back(length);
    }
  }
  lengths_ = Eigen::Map<Eigen::VectorXd>(lengths.data(), static_cast<Eigen::Index>(lengths.size()));
}

void Identification::decompose() {
  Eigen::MatrixXd scaled(rows_, static_cast<Eigen::Index>(chosen_.size()));
  for (std::size_t k = 0; k < chosen_.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    scaled.col(column) = jacobian_.col(chosen_[k]) / lengths_[column];
  }
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(
      Eigen::MatrixXd(scaled.householderQr()
                          .matrixQR()
                          .topRows(std::min<Eigen::Index>(scaled.rows(), scaled.cols()))
                          .triangularView<Eigen::Upper>()),
      Eigen::ComputeFullV);
  Eigen::VectorXd values = Eigen::VectorXd::Zero(scaled.cols());
  values.head(svd.singularValues().size()) = svd.singularValues();
  const double largest = values[0], least = values[values.size() - 1];
  result_.condition = least > 0.0 ? largest / least : std::numeric_limits<double>::infinity();
  const double not_told = fit_.exact ? not_told_exactly : not_told_by_differences;
  untold_ = least <= not_told * largest;
  weakest_ = svd.matrixV().col(scaled.cols() - 1);
  // What is not told has a variance without end; this keeps the correlation that goes with it.
  values = values.cwiseMax(1e-2 * not_told * largest);
  const Eigen::MatrixXd v = svd.matrixV() * values.cwiseInverse().asDiagonal();
  inverse_ = v * v.transpose();
}

void Identification::fill_errors() {
  double squares = 0.0;
  for (const double r : fit_.residuals) squares += r * r;
  const int freedom = rows_ - static_cast<int>(chosen_.size());
  for (int k = 0; k < static_cast<int>(chosen_.size()); ++k) {
    const int p = chosen_[k];
    const bool told = freedom > 0 && !(untold_ && std::fabs(weakest_[k]) > 0.05);
    const double scale = fit_.scales[p] / lengths_[k];
    result_.parameters[p].standard_error =
        told ? scale * std::sqrt(inverse_(k, k) * squares / freedom) : missing;
    for (int l = 0; l < static_cast<int>(chosen_.size()); ++l) {
      result_.correlation[p * all_ + chosen_[l]] =
          k == l ? 1.0 : inverse_(k, l) / std::sqrt(inverse_(k, k) * inverse_(l, l));
    }
  }
  if (freedom <= 0)
    remark(fmt::format("{} residuals cannot tell {} parameters with their errors", rows_, chosen_.size()));
}

void Identification::name_untold_direction() {
  std::vector<std::string> names;
  for (int k = 0; k < static_cast<int>(chosen_.size()); ++k) {
    if (std::fabs(weakest_[k]) > 0.05) names.push_back(name(k));
  }
  remark(fmt::format("{}: the data tell only a combination of them; fix one or excite more",
                     fmt::join(names, " and ")));
}

void Identification::name_pairs() {
  for (int k = 0; k < static_cast<int>(chosen_.size()); ++k) {
    for (int l = k + 1; l < static_cast<int>(chosen_.size()); ++l) {
      const double correlation = result_.correlation[chosen_[k] * all_ + chosen_[l]];
      if (std::fabs(correlation) > strongly_correlated)
        remark(fmt::format("{} and {}: correlation {:.3f}; fix one or excite more", name(k), name(l),
                           correlation));
    }
  }
}

void Identification::name_large_errors() {
  for (const FittedParameter& p : result_.parameters) {
    if (p.standard_error > std::fabs(p.value))
      remark(fmt::format("{}: its standard error {:.3g} is larger than its value {:.3g}", p.name,
                         p.standard_error, p.value));
  }
}

void Identification::run() {
  choose_columns();
  if (chosen_.empty()) return;
  decompose();
  fill_errors();
  if (untold_) {
    name_untold_direction();
  } else {
    name_pairs();
  }
  name_large_errors();
}

}  // namespace

void identify(const DataFit& fit, FitResult& result) {
  const std::size_t n = result.parameters.size();
  result.correlation.assign(n * n, 0.0);
  for (std::size_t p = 0; p < n; ++p) {
    result.correlation[p * n + p] = 1.0;
    result.parameters[p].standard_error = missing;
  }
  result.condition = missing;
  for (const FittedParameter& p : result.parameters) {
    if (p.at_bound) result.remarks.push_back(fmt::format("{} is at its bound {:.6g}", p.name, p.value));
  }
  if (fit.residuals.empty()) {
    result.remarks.push_back("there are no data, so there are no standard errors");
    return;
  }
  Identification(fit, result).run();
}

}  // namespace flyball
