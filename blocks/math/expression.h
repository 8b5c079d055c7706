#pragma once
#include <algorithm>

#include "blocks/block.h"

namespace flyball {

struct Expression : Block {
  static constexpr auto summary = "A formula of its inputs and of parameters of the model.";
  static constexpr std::array aliases{"EXPRESSION"};
  std::vector<std::string> names = list("inputs", {"u"}, "names of the inputs, as the formula uses them");
  Inputs u = inputs(names, "any", "variable of the formula");
  std::shared_ptr<const Formula> f =
      formula("formula", names.empty() ? "" : names[0], names,
              "the formula; names that are no inputs are parameters of the model");
  Relations greater =
      relations_each("comparison", f->comparisons, "the left side of the comparison is greater");
  Output y = output("y", "any", "value of the formula");
  // One entry an operand of the formula: an input, or else a parameter.
  std::vector<Input> variable;
  std::vector<Param> parameter;

  explicit Expression(Settings* settings) : Block(settings) {
    check_names();
    for (const std::string& name : f->operands) {
      const auto found = std::ranges::find(names, name);
      const bool is_input = found != names.end();
      variable.push_back(is_input ? u[static_cast<int>(found - names.begin())] : Input{});
      parameter.push_back(is_input ? Param{} : reference(name));
    }
  }

  void relations(auto& v) const {
    evaluate(v, [&](int k, const auto& a, const auto& b) {
      v[greater[k]] = a - b;
      return v.on(greater[k]);
    });
  }
  void outputs(auto& v) const {
    v[y] = evaluate(v, [&](int k, const auto&, const auto&) { return v.on(greater[k]); });
  }

 private:
  auto evaluate(auto& v, auto&& compare) const {
    const auto operand = [&](int i) { return variable[i].declared() ? v[variable[i]] : v[parameter[i]]; };
    return f->template evaluate<decltype(v.number(0.0))>(operand, compare);
  }
  void check_names() {
    if (names.empty() && !given("formula")) refuse("", "expected a formula, since there are no inputs");
    for (auto name = names.begin(); name != names.end(); ++name) {
      if (*name == "y") refuse("inputs", "the output is named y, so no input can be");
      if (std::find(names.begin(), name, *name) != name) {
        refuse("inputs", "the name \"" + *name + "\" stands twice");
      }
    }
  }
};

}  // namespace flyball
