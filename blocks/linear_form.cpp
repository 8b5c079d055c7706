#include "blocks/linear_form.h"

#include <algorithm>

namespace flyball {

std::optional<LinearForm> LinearForm::sum(std::vector<Term> terms) {
  std::ranges::sort(terms, {}, &Term::unknown);
  std::size_t last = 0;
  for (std::size_t k = 1; k < terms.size(); ++k) {
    if (terms[k].unknown != terms[last].unknown) {
      terms[++last] = terms[k];
      continue;
    }
    const auto total = flyball::add(terms[last].coefficient, terms[k].coefficient);
    if (!total) return std::nullopt;
    terms[last].coefficient = *total;
  }
  if (!terms.empty()) terms.resize(last + 1);
  std::erase_if(terms, [](const Term& term) { return term.coefficient.numerator() == 0; });
  LinearForm result;
  result.terms_ = std::move(terms);
  return result;
}

Rational LinearForm::coefficient(int unknown) const {
  const auto found = std::ranges::lower_bound(terms_, unknown, {}, &Term::unknown);
  return found != terms_.end() && found->unknown == unknown ? found->coefficient : Rational(0);
}

bool LinearForm::add(const LinearForm& other, const Rational& factor) {
  std::vector<Term> sum;
  sum.reserve(terms_.size() + other.terms_.size());
  auto mine = terms_.begin();
  for (const Term& term : other.terms_) {
    const auto scaled = multiply(term.coefficient, factor);
    if (!scaled) return false;
    while (mine != terms_.end() && mine->unknown < term.unknown) sum.push_back(*mine++);
    const bool shared = mine != terms_.end() && mine->unknown == term.unknown;
    const auto total = shared ? flyball::add((mine++)->coefficient, *scaled) : scaled;
    if (!total) return false;
    if (total->numerator() != 0) sum.push_back({term.unknown, *total});
  }
  sum.insert(sum.end(), mine, terms_.end());
  terms_ = std::move(sum);
  return true;
}

bool LinearForm::scale(const Rational& factor) {
  LinearForm scaled;
  if (!scaled.add(*this, factor)) return false;
  *this = std::move(scaled);
  return true;
}

}  // namespace flyball
