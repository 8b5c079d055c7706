#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "models/diagram.h"

namespace flyball {

/// One equation between the dimensions of a diagram, and what said it.
struct SignalEquation {
  /// In this order they take part: where a diagram contradicts itself without its units, the last one counts
  /// as a hidden factor.
  enum class Kind {
    equal,     // of a block, a wire or a formula
    declared,  // the unit of a port or parameter, in its block
    number,    // an argument that must be a plain number
    rate,      // a rate is its state over seconds
    literal,   // a factor in a formula is a plain number
    unit       // written in the model
  };

  Kind kind = Kind::equal;
  LinearForm form;  // is zero
  int instance = -1;
  int parameter = -1;  // of the model, where there is no instance
  int subject = -1;    // declared, unit, literal: the unknown; rate: that of the state; formula: its value
};

/// The equations of a diagram on the dimension scalar. A wire, a parameter and a value without unit are one
/// unknown each, however often they are used.
class SignalEquations {
 public:
  explicit SignalEquations(const Diagram& diagram);

  /// Sorted by kind.
  const std::vector<SignalEquation>& all() const { return equations_; }
  int unknowns() const { return unknowns_; }
  /// The unknown of a slot: that of its source, if it is an input; that of the parameter that it is bound to.
  int unknown(int instance, int slot) const;
  int unknown(int parameter) const { return base_units + parameter; }
  /// Whether a unit was written anywhere in the model.
  bool has_units() const;

  /// Whether the unknown is an output, state or held value of the block, or the parameter, whose equation it
  /// is.
  bool is_result(int unknown, const SignalEquation& equation) const;

  // For messages.
  std::string owner(const SignalEquation& equation) const;
  std::string name(int unknown) const;
  /// The value of a literal in a formula; nothing for another unknown.
  std::optional<double> literal(int unknown) const;
  /// Where the value of a parameter or literal stands, or the block of a signal. Line 0: in an override.
  Position position(int unknown) const;
  Position position(const SignalEquation& equation) const;
  const Diagram& diagram() const { return diagram_; }

 private:
  using Kind = SignalEquation::Kind;

  struct Literal {
    double value = 0.0;
    int instance = -1;
    int slot = -1;  // -1: in a formula of the block
    int parameter = -1;
  };
  /// A place that owns equations: an instance, a slot of it, or a parameter of the model.
  struct Owner {
    int instance = -1;
    int slot = -1;
    int parameter = -1;
  };

  void read_parameters();
  void read_instance(int instance);
  void read_binding(const Owner& owner, int unknown, const Binding& binding);
  void read_declarations(int instance);
  void add(Kind kind, const Owner& owner, std::vector<LinearForm::Term> terms, int subject = -1);
  void add_unit(Kind kind, const Owner& owner, int unknown, const Dimension& unit);
  void add_equal(const Owner& owner, int a, int b);
  int add_literal(const Owner& owner, const Formula::Node& node);
  std::string slot_name(int instance, int slot) const;
  std::pair<int, int> slot_of(int unknown) const;

  const Diagram& diagram_;
  std::vector<SignalEquation> equations_;
  std::vector<int> first_;  // unknown of slot 0 of each instance
  int first_literal_ = 0;
  int unknowns_ = 0;
  std::vector<Literal> literals_;
  std::map<const BlockObject*, std::vector<std::pair<int, Dimension>>> declared_;  // slots with a unit
};

}  // namespace flyball
