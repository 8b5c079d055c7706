#include "solvers/step_polynomial.h"

#include <numeric>

namespace flyball {

void StepPolynomial::fit(const Workspace<double>::Affine& map, const Extension<double>& states) {
  using Row = Extension<double>;
  begin_ = states.begin;
  scale_ = 1.0 / states.taken;
  const double* weights = map.matrix.data();
  for (std::size_t k = 0; k < terms_.size(); ++k, weights += states.size) {
    const auto sum = [&](Row::Row r) {
      return std::inner_product(weights, weights + states.size, states.row(r), 0.0);
    };
    const double start = sum(Row::start);
    terms_[k] = {map.offset[k] + map.slope[k] * begin_ + start,
                 sum(Row::end) - start + map.slope[k] * states.taken, sum(Row::first), sum(Row::last),
                 sum(Row::bubble)};
  }
}

}  // namespace flyball
