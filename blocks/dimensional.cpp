#include "blocks/dimensional.h"

#include <algorithm>
#include <cmath>

namespace flyball {

void DimensionRecorder::demand(DimensionEquation::Kind kind, LinearForm form) {
  if (form.zero()) return;
  const auto first = divide(Rational(1), form.terms().front().coefficient);
  if (!first || !form.scale(*first)) return;
  const auto said = [&](const DimensionEquation& known) { return known.form == form; };
  if (std::ranges::none_of(equations_, said)) equations_.push_back({kind, std::move(form)});
}

Dimensional::Dimensional(double value)
    : kind_(value == 0.0 || !std::isfinite(value) ? Kind::free : Kind::literal), value_(value) {}

Dimensional Dimensional::literal(double value, int unknown, bool has_unit) {
  Dimensional result(value);
  if (has_unit) result.kind_ = Kind::form;
  if (result.kind_ != Kind::free) result.form_ = LinearForm(unknown);
  return result;
}

Dimensional Dimensional::same(const Dimensional& a, const Dimensional& b) {
  if (a.kind_ != Kind::form || b.kind_ != Kind::form) return a.kind_ < b.kind_ ? b : a;
  Dimensional result = a;
  result.recorder_ = recorder(a, b);
  LinearForm difference = a.form_;
  // Where it does not fit, or nobody listens, nothing is demanded: a model is refused for a reason or not at
  // all.
  if (result.recorder_ != nullptr && difference.add(b.form_, Rational(-1))) {
    result.recorder_->demand(DimensionEquation::Kind::equal, std::move(difference));
  }
  return result;
}

Dimensional Dimensional::product(const Dimensional& a, const Dimensional& b, const Rational& exponent) {
  if (a.kind_ == Kind::free || b.kind_ == Kind::free) return {};
  Dimensional result = a;
  result.kind_ = std::max(a.kind_, b.kind_);
  result.value_ = exponent.numerator() > 0 ? a.value_ * b.value_ : a.value_ / b.value_;
  result.recorder_ = recorder(a, b);
  return result.form_.add(b.form_, exponent) ? result : Dimensional();
}

Dimensional Dimensional::number(const Dimensional& x) {
  if (x.kind_ != Kind::form) return {1.0};
  if (x.recorder_ != nullptr) x.recorder_->demand(DimensionEquation::Kind::number, x.form_);
  Dimensional result = x;
  result.form_ = {};
  return result;
}

Dimensional Dimensional::number(const Dimensional& a, const Dimensional& b) {
  const Dimensional first = number(a);
  return first * number(b);
}

Dimensional Dimensional::power(Dimensional base, double exponent) {
  const auto fraction = nearest_fraction(exponent);
  if (!fraction) return number(base);
  base.value_ = std::pow(base.value_, exponent);
  return base.form_.scale(*fraction) ? base : Dimensional();
}

Dimensional Dimensional::power(const Dimensional& base, const Dimensional& exponent) {
  if (exponent.kind_ == Kind::form) return number(base, exponent);
  return power(base, exponent.value_);
}

}  // namespace flyball
