#include "models/signal_dimensions.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "models/language/units.h"

namespace flyball {
namespace {

using Terms = std::vector<LinearForm::Term>;

SignalEquation::Kind kind_of(DimensionEquation::Kind kind) {
  switch (kind) {
    case DimensionEquation::Kind::equal:
      return SignalEquation::Kind::equal;
    case DimensionEquation::Kind::number:
      return SignalEquation::Kind::number;
    case DimensionEquation::Kind::rate:
      return SignalEquation::Kind::rate;
  }
  return {};
}

}  // namespace

SignalEquations::SignalEquations(const Diagram& diagram) : diagram_(diagram) {
  unknowns_ = unknown(static_cast<int>(diagram.parameters.size()));
  for (const Instance& instance : diagram.instances) {
    first_.push_back(unknowns_);
    unknowns_ += static_cast<int>(instance.object->specification->slots.size());
  }
  first_literal_ = unknowns_;
  read_parameters();
  for (int i = 0; i < static_cast<int>(diagram.instances.size()); ++i) read_instance(i);
  std::ranges::stable_sort(equations_, {}, &SignalEquation::kind);
}

int SignalEquations::unknown(int instance, int slot) const {
  const Instance& of = diagram_.instances[instance];
  const auto by_slot = [&](const auto& list) {
    return std::ranges::lower_bound(list, slot, {}, [](const auto& entry) { return entry.first; });
  };
  if (const auto input = by_slot(of.inputs);
      input != of.inputs.end() && input->first == slot && input->second.connected()) {
    return first_[input->second.instance] + input->second.slot;
  }
  const auto param = by_slot(of.parameters);
  const bool bound = param != of.parameters.end() && param->first == slot;
  if (bound && param->second.kind == Binding::Kind::parameter) return unknown(param->second.parameter);
  return first_[instance] + slot;
}

bool SignalEquations::has_units() const {
  return !equations_.empty() && equations_.back().kind == Kind::unit;
}

void SignalEquations::read_parameters() {
  for (int p = 0; p < static_cast<int>(diagram_.parameters.size()); ++p) {
    const Parameter& parameter = diagram_.parameters[p];
    const Owner owner{-1, -1, p};
    read_binding(owner, unknown(p), parameter.binding);
    if (parameter.declared) add_unit(Kind::unit, owner, unknown(p), *parameter.declared);
  }
}

void SignalEquations::read_instance(int instance) {
  const Instance& of = diagram_.instances[instance];
  const BlockObject& object = *of.object;
  const Owner owner{instance, -1, -1};
  const int first_literal = unknowns_;
  for (const Formula::Node& node : object.specification->literals) add_literal(owner, node);
  Terms terms;
  for (const DimensionEquation& equation : object.dimensions) {
    terms.clear();
    int state = -1;
    for (const auto& [local, coefficient] : equation.form.terms()) {
      const bool is_slot = local >= base_units;
      const int slot = local - base_units;
      const int global = is_slot     ? unknown(instance, slot)
                         : local < 0 ? first_literal + Formula::literal_unknown(local)
                                     : local;
      terms.push_back({global, coefficient});
      if (is_slot && object.specification->slots[slot].kind == SlotKind::state) state = global;
    }
    const Kind kind = kind_of(equation.kind);
    add(kind, owner, terms, kind == Kind::rate ? state : -1);
  }
  for (const PassThrough& passed : object.specification->passed) {
    add_equal(owner, unknown(instance, passed.output), unknown(instance, passed.input));
  }
  for (const auto& [slot, binding] : of.parameters) {
    if (binding.kind != Binding::Kind::parameter) {
      read_binding({instance, slot, -1}, unknown(instance, slot), binding);
    }
  }
  read_declarations(instance);
}

void SignalEquations::read_declarations(int instance) {
  const BlockObject* object = diagram_.instances[instance].object.get();
  auto known = declared_.find(object);
  if (known == declared_.end()) {
    known = declared_.try_emplace(object).first;
    const auto& slots = object->specification->slots;
    for (int s = 1; s < static_cast<int>(slots.size()); ++s) {
      const bool is_signal = slots[s].numeric() && slots[s].kind != SlotKind::alarm;
      const auto unit = is_signal ? declared_dimension(slots[s].unit) : std::nullopt;
      if (unit) known->second.emplace_back(s, *unit);
    }
  }
  for (const auto& [slot, unit] : known->second) {
    add_unit(Kind::declared, {instance, slot, -1}, unknown(instance, slot), unit);
  }
}

void SignalEquations::read_binding(const Owner& owner, int unknown, const Binding& binding) {
  if (binding.unit) add_unit(Kind::unit, owner, unknown, *binding.unit);
  if (binding.kind == Binding::Kind::parameter)
    return add_equal(owner, unknown, this->unknown(binding.parameter));
  if (binding.kind != Binding::Kind::formula) return;
  const Formula& formula = *binding.formula;
  const int first_literal = unknowns_;
  for (const Formula::Node& node : formula.nodes) {
    if (node.op == Formula::Op::literal) add_literal(owner, node);
  }
  DimensionRecorder recorder;
  const auto operand = [&](int k) { return Dimensional(this->unknown(binding.operands[k]), recorder); };
  const auto compare = [](int, const Dimensional& a, const Dimensional& b) {
    Dimensional::same(a, b);
    return false;
  };
  const Dimensional result = formula.evaluate<Dimensional>(operand, compare);
  Dimensional::same(Dimensional(unknown, recorder), result);
  for (DimensionEquation& equation : recorder.take()) {
    Terms terms = equation.form.terms();
    for (auto& term : terms) {
      if (term.unknown < 0) term.unknown = first_literal + Formula::literal_unknown(term.unknown);
    }
    const bool is_value = equation.form.coefficient(unknown).numerator() != 0;
    add(kind_of(equation.kind), owner, std::move(terms), is_value ? unknown : -1);
  }
}

int SignalEquations::add_literal(const Owner& owner, const Formula::Node& node) {
  const int unknown = unknowns_++;
  literals_.push_back({node.value, owner.instance, owner.slot, owner.parameter});
  add_unit(node.dimension ? Kind::unit : Kind::literal, owner, unknown, node.dimension.value_or(Dimension{}));
  return unknown;
}

void SignalEquations::add_unit(Kind kind, const Owner& owner, int unknown, const Dimension& unit) {
  Terms terms{{unknown, 1}};
  for (int k = 0; k < base_units; ++k) {
    if (unit.exponent[k] != 0) terms.push_back({k, Rational(-unit.exponent[k])});
  }
  add(kind, owner, std::move(terms), unknown);
}

void SignalEquations::add_equal(const Owner& owner, int a, int b) {
  add(Kind::equal, owner, {{a, 1}, {b, -1}});
}

void SignalEquations::add(Kind kind, const Owner& owner, Terms terms, int subject) {
  auto form = LinearForm::sum(std::move(terms));
  if (form && !form->zero())
    equations_.push_back({kind, *std::move(form), owner.instance, owner.parameter, subject});
}

std::pair<int, int> SignalEquations::slot_of(int unknown) const {
  const auto next = std::ranges::upper_bound(first_, unknown);
  const int instance = static_cast<int>(next - first_.begin()) - 1;
  return {instance, unknown - first_[instance]};
}

bool SignalEquations::is_result(int unknown, const SignalEquation& equation) const {
  if (equation.instance < 0) return unknown == this->unknown(equation.parameter);
  const auto& slots = diagram_.instances[equation.instance].object->specification->slots;
  const int slot = unknown - first_[equation.instance];
  if (slot < 0 || slot >= static_cast<int>(slots.size())) return false;
  return slots[slot].kind == SlotKind::output || slots[slot].kind == SlotKind::state ||
         slots[slot].kind == SlotKind::held;
}

std::string SignalEquations::owner(const SignalEquation& equation) const {
  return equation.instance < 0 ? diagram_.parameters[equation.parameter].name
                               : diagram_.instances[equation.instance].name;
}

/// The port that shows the slot; the only output goes by the block's name.
std::string SignalEquations::slot_name(int instance, int slot) const {
  const Instance& of = diagram_.instances[instance];
  const Specification& spec = *of.object->specification;
  const PortSpec* shown = nullptr;
  int outputs = 0;
  for (const PortSpec& port : spec.ports) {
    outputs += port.is_input ? 0 : 1;
    if (std::ranges::find(port.slots, slot) != port.slots.end()) shown = &port;
  }
  if (shown == nullptr) return fmt::format("{}.{}", of.name, spec.slots[slot].name);
  if (!shown->is_input && outputs == 1 && shown->elements.empty()) return of.name;
  const std::string port = fmt::format("{}.{}", of.name, shown->name);
  if (shown->elements.empty()) return port;
  const auto element = std::ranges::find(shown->slots, slot) - shown->slots.begin();
  return fmt::format("{}.{}", port, shown->elements[element]);
}

std::optional<double> SignalEquations::literal(int unknown) const {
  return unknown < first_literal_ ? std::nullopt : std::optional(literals_[unknown - first_literal_].value);
}

std::string SignalEquations::name(int unknown) const {
  if (unknown < first_literal_) {
    const int parameter = unknown - base_units;
    if (parameter < static_cast<int>(diagram_.parameters.size())) return diagram_.parameters[parameter].name;
    const auto [instance, slot] = slot_of(unknown);
    return slot_name(instance, slot);
  }
  const Literal& literal = literals_[unknown - first_literal_];
  if (literal.parameter >= 0)
    return fmt::format("{} in {}", literal.value, diagram_.parameters[literal.parameter].name);
  if (literal.slot >= 0)
    return fmt::format("{} in {}", literal.value, slot_name(literal.instance, literal.slot));
  return fmt::format("{} in {}", literal.value, diagram_.instances[literal.instance].name);
}

Position SignalEquations::position(int unknown) const {
  int parameter = unknown - base_units;
  int instance = -1, slot = -1;
  if (unknown >= first_literal_) {
    const Literal& literal = literals_[unknown - first_literal_];
    parameter = literal.parameter;
    instance = literal.instance;
    slot = literal.slot;
  } else if (parameter >= static_cast<int>(diagram_.parameters.size())) {
    std::tie(instance, slot) = slot_of(unknown);
  }
  if (instance < 0) return diagram_.parameters[parameter].binding.at;
  const Instance& of = diagram_.instances[instance];
  const auto bound = std::ranges::find(of.parameters, slot, [](const auto& entry) { return entry.first; });
  return bound == of.parameters.end() ? of.at : bound->second.at;
}

Position SignalEquations::position(const SignalEquation& equation) const {
  if (equation.kind == Kind::unit || equation.kind == Kind::literal) return position(equation.subject);
  if (equation.instance < 0) return position(unknown(equation.parameter));
  return diagram_.instances[equation.instance].at;
}

}  // namespace flyball
