#include "models/dimension_conflict.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <unordered_map>

#include "models/dimension_system.h"

namespace flyball {
namespace {

using Kind = SignalEquation::Kind;

/// Places in `active` by their distance from `start`, over common unknowns.
std::vector<int> by_distance(const SignalEquations& equations, const std::vector<int>& active, int start) {
  std::vector<std::vector<int>> users(equations.unknowns());
  for (int place = 0; place < static_cast<int>(active.size()); ++place) {
    for (const auto& term : equations.all()[active[place]].form.terms()) users[term.unknown].push_back(place);
  }
  std::vector<int> order{start};
  std::vector<bool> seen(active.size());
  seen[start] = true;
  for (std::size_t k = 0; k < order.size(); ++k) {
    for (const auto& term : equations.all()[active[order[k]]].form.terms()) {
      if (term.unknown < base_units) continue;
      for (const int place : users[term.unknown]) {
        if (!seen[place]) order.push_back(place);
        seen[place] = true;
      }
      users[term.unknown].clear();
    }
  }
  return order;
}

/// Reduces a contradiction to equations of which none can be missed, with as few trials as the number of
/// those wants: QuickXplain, Junker 2004. Equations that stand first are kept rather than later ones.
class Minimiser {
 public:
  Minimiser(const SignalEquations& equations, const std::vector<int>& candidates)
      : forms_(candidates.size()) {
    std::unordered_map<int, int> compact;
    const auto local = [&](int unknown) {
      if (unknown < base_units) return unknown;
      return compact.emplace(unknown, base_units + static_cast<int>(compact.size())).first->second;
    };
    for (std::size_t k = 0; k < candidates.size(); ++k) {
      for (const auto& term : equations.all()[candidates[k]].form.terms()) {
        // What fitted before fits under another name.
        (void)forms_[k].add(LinearForm(local(term.unknown)), term.coefficient);
      }
    }
    unknowns_ = base_units + static_cast<int>(compact.size());
  }

  bool contradict(const std::vector<int>& chosen) const {
    std::vector<const LinearForm*> forms;
    for (const int k : chosen) forms.push_back(&forms_[k]);
    return !DimensionSystem(unknowns_, forms).contradictions().empty();
  }

  std::vector<int> minimal() const {
    std::vector<int> all(forms_.size());
    for (std::size_t k = 0; k < all.size(); ++k) all[k] = static_cast<int>(k);
    return needed({}, false, all);
  }

 private:
  std::vector<int> needed(const std::vector<int>& given, bool more_than_before,
                          const std::vector<int>& candidates) const {
    if (more_than_before && contradict(given)) return {};
    if (candidates.size() == 1) return candidates;
    const auto middle = candidates.begin() + static_cast<std::ptrdiff_t>(candidates.size() / 2);
    const std::vector<int> near(candidates.begin(), middle), far(middle, candidates.end());
    const std::vector<int> of_far = needed(joined(given, near), true, far);
    const std::vector<int> of_near = needed(joined(given, of_far), !of_far.empty(), near);
    return joined(of_near, of_far);
  }

  static std::vector<int> joined(std::vector<int> a, const std::vector<int>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
  }

  std::vector<LinearForm> forms_;
  int unknowns_ = 0;
};

std::vector<int> irreducible(const SignalEquations& equations, const std::vector<int>& active, int start) {
  std::vector<int> near;
  for (const int place : by_distance(equations, active, start)) near.push_back(active[place]);
  for (std::size_t size = 16;; size *= 2) {
    const bool whole = size >= near.size();
    const std::vector<int> ball(near.begin(),
                                whole ? near.end() : near.begin() + static_cast<std::ptrdiff_t>(size));
    const Minimiser minimiser(equations, ball);
    std::vector<int> all(ball.size());
    for (std::size_t k = 0; k < all.size(); ++k) all[k] = static_cast<int>(k);
    if (!minimiser.contradict(all)) {
      if (whole) return {};  // in this order a number does not fit
      continue;
    }
    std::vector<int> result;
    for (const int k : minimiser.minimal()) result.push_back(ball[k]);
    return result;
  }
}

std::vector<int> without(std::vector<int> list, int element) {
  std::erase(list, element);
  return list;
}

DimensionSystem system_of(const SignalEquations& equations, const std::vector<int>& chosen) {
  std::vector<const LinearForm*> forms;
  for (const int k : chosen) forms.push_back(&equations.all()[k].form);
  return {equations.unknowns(), forms};
}

Suspect suspect_of(const SignalEquations& equations, const std::vector<int>& active,
                   const std::vector<int>& conflict, int number) {
  const SignalEquation& equation = equations.all()[number];
  Suspect suspect;
  suspect.equation = number;
  suspect.unit = LinearForm(equation.subject);
  // The form is the subject over its unit.
  if (!suspect.unit.add(equation.form, Rational(-1))) suspect.unit = {};
  suspect.needed = system_of(equations, without(conflict, number))
                       .reduced(LinearForm(equation.subject))
                       .value_or(LinearForm());
  suspect.remaining = static_cast<int>(system_of(equations, without(active, number)).contradictions().size());
  return suspect;
}

/// How many base units a unit is made of; a broken exponent is hardly ever meant.
double complexity(const LinearForm& unit) {
  double sum = 0.0;
  for (const auto& [base, exponent] : unit.terms()) {
    sum += std::abs(exponent.value()) + (exponent.denominator() == 1 ? 0.0 : 10.0);
  }
  return sum;
}

/// What was written with a unit is suspected before a factor that was written without one, and a correction
/// most often makes a unit simpler.
auto rank(const SignalEquations& equations, const Suspect& suspect) {
  const SignalEquation& equation = equations.all()[suspect.equation];
  const bool from_file = equations.position(equation.subject).line > 0;
  const bool plain = equation.kind == Kind::literal;
  const double needed = complexity(suspect.needed);
  return std::tuple(from_file, suspect.remaining, plain, needed - complexity(suspect.unit), needed,
                    suspect.equation);
}

}  // namespace

Conflict find_conflict(const SignalEquations& equations, const std::vector<int>& active,
                       const std::vector<int>& contradictions) {
  Conflict conflict;
  conflict.equations = irreducible(equations, active, contradictions.front());
  for (const int number : conflict.equations) {
    const Kind kind = equations.all()[number].kind;
    if (kind != Kind::unit && kind != Kind::literal) continue;
    conflict.suspects.push_back(suspect_of(equations, active, conflict.equations, number));
  }
  std::ranges::sort(conflict.suspects, {}, [&](const Suspect& suspect) { return rank(equations, suspect); });
  conflict.settled = !conflict.suspects.empty() &&
                     conflict.suspects.front().remaining < static_cast<int>(contradictions.size());
  return conflict;
}

}  // namespace flyball
