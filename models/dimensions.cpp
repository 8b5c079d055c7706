#include "models/dimensions.h"

#include <algorithm>

#include "models/dimension_conflict.h"
#include "models/dimension_messages.h"
#include "models/dimension_report.h"
#include "models/dimension_system.h"

namespace flyball {
namespace {

using Kind = SignalEquation::Kind;

std::vector<const LinearForm*> forms_of(const SignalEquations& equations, const std::vector<int>& chosen) {
  std::vector<const LinearForm*> forms;
  for (const int number : chosen) forms.push_back(&equations.all()[number].form);
  return forms;
}

/// The equations of a diagram, eliminated twice: without the units of the model, and then with them.
class Analysis {
 public:
  explicit Analysis(const Diagram& diagram)
      : equations_(diagram), active_(consistent_without_units()), system_(system()) {}

  bool has_units() const { return equations_.has_units(); }

  void report(Diagnostics& diagnostics) {
    constexpr int most = 20;
    for (int k = 0; k < most && !system_.contradictions().empty(); ++k) {
      Conflict conflict = find_conflict(equations_, active_, system_.contradictions());
      if (conflict.suspects.empty()) return;
      report_conflict(equations_, conflict, diagnostics);
      std::erase(active_, conflict.suspects.front().equation);
      system_ = system();
    }
  }

  std::vector<Diagnostic> notes() {
    std::vector<Diagnostic> result;
    for (const int number : hidden_) {
      const SignalEquation& equation = equations_.all()[number];
      result.push_back({Diagnostic::Severity::note, equations_.diagram().file, equations_.position(equation),
                        note(equation)});
    }
    return result;
  }

  /// Empty where the model does not determine it.
  std::string unit(int unknown) {
    const auto form = system_.reduced(LinearForm(unknown));
    return form && is_unit(*form) ? message::unit_text(*form) : "";
  }
  std::string unit(Endpoint signal) { return unit(equations_.unknown(signal.instance, signal.slot)); }
  /// As declared: rad/s says more than its dimension does.
  NamedUnit named(int unknown, const std::string& declared) {
    return {equations_.name(unknown), declared == "any" ? unit(unknown) : declared};
  }
  NamedUnit parameter(int parameter) {
    return named(equations_.unknown(parameter), equations_.diagram().parameters[parameter].unit);
  }
  void append(int instance, const PortSpec& port, std::vector<NamedUnit>& all) {
    for (const int slot : port.slots) {
      const SlotSpec& spec = equations_.diagram().instances[instance].object->specification->slots[slot];
      if (spec.numeric()) all.push_back(named(equations_.unknown(instance, slot), spec.unit));
    }
  }

 private:
  std::vector<int> consistent_without_units() {
    std::vector<int> laws, active;
    for (int k = 0; k < static_cast<int>(equations_.all().size()); ++k) {
      (equations_.all()[k].kind == Kind::unit ? active : laws).push_back(k);
    }
    DimensionSystem system(equations_.unknowns(), forms_of(equations_, laws));
    for (const int place : system.contradictions()) hidden_.push_back(laws[place]);
    for (const int law : laws) {
      if (!std::ranges::binary_search(hidden_, law)) active.push_back(law);
    }
    return active;
  }

  DimensionSystem system() const { return {equations_.unknowns(), forms_of(equations_, active_)}; }

  static bool is_unit(const LinearForm& form) {
    return form.zero() || form.terms().back().unknown < base_units;
  }

  std::string note(const SignalEquation& equation) {
    // What the equation would have to be multiplied by.
    LinearForm form = equation.form;
    const auto exponent =
        equation.subject < 0 ? std::nullopt : divide(Rational(1), form.coefficient(equation.subject));
    const bool fits = exponent && form.scale(*exponent);
    const auto factor = fits ? system_.reduced(form) : std::nullopt;
    const LinearForm* unit = factor && is_unit(*factor) ? &*factor : nullptr;
    if (equation.kind == Kind::literal)
      return message::hidden_in_literal(equations_.name(equation.subject), unit);
    if (equation.kind == Kind::rate) return message::hidden_in_rate(equations_.name(equation.subject), unit);
    return message::hidden_before(equation_text(equations_, equation));
  }

  SignalEquations equations_;
  std::vector<int> hidden_;  // left out, since they hide a factor
  std::vector<int> active_;  // units first: they leave little to eliminate
  DimensionSystem system_;
};

}  // namespace

void check_dimensions(Diagram& diagram, Diagnostics& diagnostics) {
  Analysis analysis(diagram);
  analysis.report(diagnostics);
  if (diagnostics.failed()) return;
  const std::vector<Diagnostic> notes = analysis.notes();
  // Without any unit a hidden factor most often means that time is scaled, too: seconds would be a guess.
  if (!analysis.has_units() && !notes.empty()) return;
  for (const Diagnostic& note : notes) diagnostics.note(note.at, note.message);
  for (Logged& logged : diagram.logged) {
    if (logged.unit != "any") continue;
    const std::string unit = analysis.unit(logged.source);
    if (!unit.empty()) logged.unit = unit;
  }
}

DimensionTable dimension_table(const Diagram& diagram) {
  Analysis analysis(diagram);
  DimensionTable table;
  table.notes = analysis.notes();
  for (int i = 0; i < static_cast<int>(diagram.instances.size()); ++i) {
    for (const PortSpec& port : diagram.instances[i].object->specification->ports) {
      if (!port.is_input) analysis.append(i, port, table.signals);
    }
  }
  for (int p = 0; p < static_cast<int>(diagram.parameters.size()); ++p) {
    table.parameters.push_back(analysis.parameter(p));
  }
  return table;
}

}  // namespace flyball
