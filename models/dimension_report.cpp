#include "models/dimension_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

#include "models/dimension_messages.h"

namespace flyball {
namespace {

using Kind = SignalEquation::Kind;

std::string name_of(const SignalEquations& equations, int unknown) {
  if (unknown < base_units) return message::unit_text(LinearForm(unknown));
  const auto literal = equations.literal(unknown);
  return literal ? fmt::format("{}", *literal) : equations.name(unknown);
}

void append_factor(std::string& product, const std::string& name, const Rational& exponent) {
  if (!product.empty()) product += '*';
  product += name;
  if (exponent == Rational(1)) return;
  product += exponent.denominator() == 1
                 ? fmt::format("^{}", exponent.numerator())
                 : fmt::format("^({}/{})", exponent.numerator(), exponent.denominator());
}

/// The form as "a*b/c".
std::string product_text(const SignalEquations& equations, const LinearForm& form) {
  std::string above, below;
  int divisors = 0;
  auto terms = form.terms();
  const auto is_literal = [&](const auto& term) {
    return term.unknown >= base_units && equations.literal(term.unknown).has_value();
  };
  std::stable_partition(terms.begin(), terms.end(), is_literal);
  for (const auto& [unknown, exponent] : terms) {
    const bool divides = exponent.numerator() < 0;
    const Rational size = divides ? subtract(Rational(0), exponent).value_or(exponent) : exponent;
    append_factor(divides ? below : above, name_of(equations, unknown), size);
    divisors += divides ? 1 : 0;
  }
  if (above.empty()) above += '1';
  if (divisors > 1) below = fmt::format("({})", below);
  return divisors == 0 ? above : above + '/' + below;
}

/// What the equation says what it is: of a rate its state, else a result of the block.
int subject_of(const SignalEquations& equations, const SignalEquation& equation) {
  if (equation.subject >= 0) return equation.subject;
  int subject = -1;
  for (const auto& [unknown, exponent] : equation.form.terms()) {
    if (unknown < base_units) continue;
    const bool alone = exponent == Rational(1) || exponent == Rational(-1);
    if (subject < 0 || (alone && equations.is_result(unknown, equation))) subject = unknown;
  }
  return subject;
}

/// The equation solved for its subject: the subject's unit is this product.
LinearForm solved(const LinearForm& form, int subject) {
  LinearForm rest = form;
  const auto factor = divide(Rational(-1), form.coefficient(subject));
  if (!factor || !rest.scale(*factor) || !rest.add(LinearForm(subject))) return {};
  return rest;
}

/// Walks through a contradiction, from the units to where they meet.
class Derivation {
 public:
  Derivation(const SignalEquations& equations, const Conflict& conflict, Diagnostics& diagnostics)
      : equations_(equations), left_(conflict.equations), diagnostics_(diagnostics) {}

  void tell() {
    while (left_.size() > 1) {
      const auto next = next_step();
      if (next == left_.end()) break;
      const SignalEquation& equation = equations_.all()[*next];
      left_.erase(next);
      tell_step(equation);
    }
    for (const int number : left_) {
      const SignalEquation& equation = equations_.all()[number];
      const std::string text = equation_text(equations_, equation);
      note(equation, left_.size() == 1 ? message::does_not_fit(text) : text);
    }
  }

 private:
  void note(const SignalEquation& equation, std::string text) {
    diagnostics_.note(equations_.position(equation), std::move(text));
  }

  /// How much of the equation is not known yet.
  int open_unknowns(const SignalEquation& equation) const {
    return static_cast<int>(std::ranges::count_if(equation.form.terms(), [&](const auto& term) {
      return term.unknown >= base_units && !known_.contains(term.unknown);
    }));
  }

  /// What follows from what is known comes first, then what the model says, then what blocks declare and
  /// want.
  std::vector<int>::iterator next_step() {
    const auto cost = [&](int number) {
      const SignalEquation& equation = equations_.all()[number];
      if (open_unknowns(equation) != 1) return 4;
      if (equation.kind == Kind::equal || equation.kind == Kind::rate) return 0;
      if (equation.kind == Kind::unit) return 1;
      return equation.kind == Kind::literal ? 2 : 3;
    };
    const auto best = std::ranges::min_element(left_, {}, cost);
    return cost(*best) < 4 ? best : left_.end();
  }

  void tell_step(const SignalEquation& equation) {
    int subject = -1;
    for (const auto& term : equation.form.terms()) {
      if (term.unknown >= base_units && !known_.contains(term.unknown)) subject = term.unknown;
    }
    LinearForm unit;
    const LinearForm rest = solved(equation.form, subject);
    for (const auto& [unknown, exponent] : rest.terms()) {
      if (!unit.add(unknown < base_units ? LinearForm(unknown) : known_.at(unknown), exponent)) return;
    }
    const bool stated = equation.form.terms().size() == 1 || equation.kind == Kind::unit ||
                        equation.kind == Kind::declared || equation.kind == Kind::literal;
    const std::string text = equation_text(equations_, equation);
    note(equation, stated ? text : message::follows(text, equations_.name(subject), unit));
    known_.emplace(subject, std::move(unit));
  }

  const SignalEquations& equations_;
  std::vector<int> left_;
  Diagnostics& diagnostics_;
  std::unordered_map<int, LinearForm> known_;
};

}  // namespace

std::string equation_text(const SignalEquations& equations, const SignalEquation& equation) {
  const int subject = subject_of(equations, equation);
  const LinearForm rest = solved(equation.form, subject);
  const std::string name = equations.name(subject);
  switch (equation.kind) {
    case Kind::unit:
    case Kind::literal:
      return message::is_in_unit(name, rest);
    case Kind::declared:
      return message::is_declared_in(name, rest);
    case Kind::number:
      return message::wants_number(equations.owner(equation), product_text(equations, equation.form));
    case Kind::rate: {
      LinearForm rate(subject), other = rest;
      const LinearForm seconds(2);
      if (!rate.add(seconds, Rational(-1)) || !other.add(seconds, Rational(-1))) return name;
      return fmt::format("{} = {}", product_text(equations, rate), product_text(equations, other));
    }
    case Kind::equal:
      break;
  }
  if (rest.zero() || rest.terms().back().unknown < base_units) return message::is_in_unit(name, rest);
  const std::string text = fmt::format("{} = {}", name, product_text(equations, rest));
  const bool says_whose =
      equation.instance < 0 || equation.subject >= 0 || equations.is_result(subject, equation);
  return says_whose ? text : fmt::format("{}: {}", equations.owner(equation), text);
}

void report_conflict(const SignalEquations& equations, const Conflict& conflict, Diagnostics& diagnostics) {
  const Suspect& first = conflict.suspects.front();
  const auto subject = [&](const Suspect& suspect) { return equations.all()[suspect.equation].subject; };
  const std::string name = equations.name(subject(first));
  const Position at = equations.position(subject(first));
  diagnostics.error(at, at.line > 0
                            ? message::unit_contradicts(name, first.unit, first.needed, conflict.settled)
                            : message::override_contradicts(name, first.unit, first.needed));
  Derivation(equations, conflict, diagnostics).tell();
  for (const Suspect& suspect : conflict.suspects) {
    if (suspect.equation == first.equation) continue;
    const bool as_good = conflict.settled && suspect.remaining == first.remaining;
    const std::string other = equations.name(subject(suspect));
    diagnostics.note(equations.position(subject(suspect)),
                     as_good ? message::would_settle(other, suspect.needed)
                             : message::would_have_to_be(other, suspect.needed));
  }
}

}  // namespace flyball
