#pragma once

#include <optional>
#include <vector>

#include "blocks/dimension.h"
#include "blocks/linear_form.h"

namespace flyball {

/// Equations between exponents, eliminated exactly: each form is zero. The first `base_units` unknowns are
/// the base units, which are never solved for. Where a number would not fit 64 bits, or a form would grow out
/// of all proportion, the equation is left out: a diagram is refused for a reason or not at all.
class DimensionSystem {
 public:
  /// Takes the equations in their order; `unknowns` is above each unknown in them.
  DimensionSystem(int unknowns, const std::vector<const LinearForm*>& equations);

  /// The equations that contradict those before them, and are left out.
  const std::vector<int>& contradictions() const { return contradictions_; }

  /// What a form comes down to: base units and what stays unknown. Nothing when that does not fit.
  std::optional<LinearForm> reduced(const LinearForm& form);

 private:
  void count(const std::vector<const LinearForm*>& equations);
  std::vector<std::pair<int, int>> peel(const std::vector<const LinearForm*>& equations);
  void add(int number, const LinearForm& equation);
  /// False when the solution for `unknown` does not fit.
  bool solve(const LinearForm& equation, int unknown);
  bool resolve(int unknown);
  bool substitute(LinearForm& form) const;
  /// Whether no unknown of the form has a solution.
  bool settled(const LinearForm& form) const;

  std::vector<int> uses_;         // equations that an unknown is in
  std::vector<int> sum_of_uses_;  // of their numbers, by exclusive or: the number itself when there is one
  std::vector<char> solved_;      // whether an unknown has a solution
  std::vector<LinearForm> solution_;
  std::vector<int> contradictions_;
};

}  // namespace flyball
