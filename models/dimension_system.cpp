#include "models/dimension_system.h"

#include <algorithm>

namespace flyball {
namespace {

// Sums of more terms come from dense networks of values without units, which determine nothing.
constexpr std::size_t longest_form = 1000;

bool is_unknown(const LinearForm::Term& term) { return term.unknown >= base_units; }

}  // namespace

DimensionSystem::DimensionSystem(int unknowns, const std::vector<const LinearForm*>& equations)
    : uses_(unknowns), sum_of_uses_(unknowns), solved_(unknowns), solution_(unknowns) {
  count(equations);
  std::vector<bool> peeled(equations.size());
  const auto order = peel(equations);
  for (const auto& [number, unknown] : order) peeled[number] = true;
  for (int number = 0; number < static_cast<int>(equations.size()); ++number) {
    if (!peeled[number]) add(number, *equations[number]);
  }
  for (const auto& [number, unknown] : order) solve(*equations[number], unknown);
}

void DimensionSystem::count(const std::vector<const LinearForm*>& equations) {
  for (int number = 0; number < static_cast<int>(equations.size()); ++number) {
    for (const auto& term : equations[number]->terms()) {
      if (!is_unknown(term)) continue;
      ++uses_[term.unknown];
      sum_of_uses_[term.unknown] ^= number;
    }
  }
}

/// An equation with an unknown that no other has only says what that unknown is: it contradicts nothing. Most
/// of a diagram without units goes this way, gain by gain.
std::vector<std::pair<int, int>> DimensionSystem::peel(const std::vector<const LinearForm*>& equations) {
  std::vector<int> single;
  std::vector<int> left = uses_;
  for (int u = base_units; u < static_cast<int>(left.size()); ++u) {
    if (left[u] == 1) single.push_back(u);
  }
  std::vector<std::pair<int, int>> order;
  while (!single.empty()) {
    const int unknown = single.back();
    single.pop_back();
    if (left[unknown] != 1) continue;
    const int number = sum_of_uses_[unknown];
    order.emplace_back(number, unknown);
    for (const auto& term : equations[number]->terms()) {
      if (!is_unknown(term)) continue;
      sum_of_uses_[term.unknown] ^= number;
      if (--left[term.unknown] == 1) single.push_back(term.unknown);
    }
  }
  return order;
}

void DimensionSystem::add(int number, const LinearForm& equation) {
  const auto rest = reduced(equation);
  if (!rest || rest->zero()) return;
  const auto rarest = std::ranges::min_element(rest->terms(), {}, [&](const LinearForm::Term& term) {
    return std::pair(!is_unknown(term), uses_[term.unknown]);
  });
  if (is_unknown(*rarest)) {
    solve(*rest, rarest->unknown);
  } else {
    contradictions_.push_back(number);
  }
}

bool DimensionSystem::solve(const LinearForm& equation, int unknown) {
  LinearForm solution = equation;
  const auto factor = divide(Rational(-1), equation.coefficient(unknown));
  if (!factor || !solution.scale(*factor) || !solution.add(LinearForm(unknown))) return false;
  solution_[unknown] = std::move(solution);
  solved_[unknown] = 1;
  return true;
}

bool DimensionSystem::settled(const LinearForm& form) const {
  return std::ranges::none_of(form.terms(), [&](const auto& term) { return solved_[term.unknown] != 0; });
}

bool DimensionSystem::substitute(LinearForm& form) const {
  LinearForm result = form;
  for (const auto& [unknown, coefficient] : form.terms()) {
    if (solved_[unknown] == 0) continue;
    const auto opposite = subtract(Rational(0), coefficient);
    if (!opposite || !result.add(LinearForm(unknown), *opposite)) return false;
    if (!result.add(solution_[unknown], coefficient)) return false;
  }
  if (result.terms().size() > longest_form) return false;
  form = std::move(result);
  return true;
}

/// A solution only uses unknowns that were solved later or never, so there is an end; each is stored when it
/// is found, so that long chains are walked once.
bool DimensionSystem::resolve(int unknown) {
  std::vector<int> pending{unknown};
  while (!pending.empty()) {
    const int at = pending.back();
    const std::size_t before = pending.size();
    for (const auto& term : solution_[at].terms()) {
      if (solved_[term.unknown] != 0 && !settled(solution_[term.unknown])) pending.push_back(term.unknown);
    }
    if (pending.size() > before) continue;
    if (!settled(solution_[at]) && !substitute(solution_[at])) return false;
    pending.pop_back();
  }
  return true;
}

std::optional<LinearForm> DimensionSystem::reduced(const LinearForm& form) {
  for (const auto& term : form.terms()) {
    if (solved_[term.unknown] != 0 && !resolve(term.unknown)) return std::nullopt;
  }
  LinearForm result = form;
  if (settled(result)) return result;
  return substitute(result) ? std::optional(std::move(result)) : std::nullopt;
}

}  // namespace flyball
