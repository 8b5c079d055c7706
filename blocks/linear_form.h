#pragma once

#include <optional>
#include <vector>

#include "blocks/rational.h"

namespace flyball {

/// A sum of rational multiples of unknowns. Arithmetic is checked: where a number does not fit 64 bits, the
/// operation says so and changes nothing.
class LinearForm {
 public:
  struct Term {
    int unknown = 0;
    Rational coefficient;

    bool operator==(const Term&) const = default;
  };

  LinearForm() = default;
  explicit LinearForm(int unknown) : terms_{{unknown, Rational(1)}} {}
  /// The sum of terms in any order; nothing when a number does not fit.
  static std::optional<LinearForm> sum(std::vector<Term> terms);

  /// Ascending by unknown, without zeros.
  const std::vector<Term>& terms() const { return terms_; }
  bool zero() const { return terms_.empty(); }
  /// 0 where the unknown is not in the form.
  Rational coefficient(int unknown) const;

  /// Adds factor * other; false when a number does not fit.
  [[nodiscard]] bool add(const LinearForm& other, const Rational& factor = Rational(1));
  /// Multiplies by the factor; false when a number does not fit.
  [[nodiscard]] bool scale(const Rational& factor);

  bool operator==(const LinearForm&) const = default;

 private:
  std::vector<Term> terms_;
};

}  // namespace flyball
