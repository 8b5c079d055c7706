#pragma once

#include <memory>
#include <string>
#include <typeinfo>
#include <vector>

#include "blocks/handles.h"
#include "blocks/settings.h"
#include "blocks/specification.h"
#include "blocks/state_limits.h"
#include "blocks/time_series.h"
#include "blocks/view.h"

namespace flyball {

/// The base of every block. A block is a struct of declarations and equations:
///
///   struct Gain : Block {
///     static constexpr auto summary = "Multiplies its input.";
///     Param gain = param("gain", 1.0, "any", any, "factor");
///     Input u = input("u", "any", "signal");
///     Output y = output("y", "any", "gain times the signal");
///     void outputs(auto& v) const { v[y] = v[gain] * v[u]; }
///   };
///
/// Each declaration takes a slot and records its specification; names, units, ranges and texts are said
/// nowhere else. An object is immutable and shared by all instances of equal structure.
/// docs/guide/first-block.md shows each kind of declaration with the method that belongs to it.
class Block {
 public:
  explicit Block(Settings* settings);
  const Specification& specification() const { return spec_; }
  /// Settings are there while the block is constructed, and no longer.
  void seal() { settings_ = nullptr; }

 protected:
  /// A number that runs, sweeps and fits may change. `unit` is SI, "1" for a number, "any" when the equations
  /// decide.
  Param param(std::string name, double fallback, std::string unit, Range range, std::string doc);
  /// A parameter of the model under its own name: the free name of a formula.
  Param reference(const std::string& name);

  /// An input that must be connected; with `fallback`, one that has this value when it is not.
  Input input(std::string name, std::string unit, std::string doc);
  Input input(std::string name, std::string unit, std::string doc, double fallback);
  /// Ports with the given names, in consecutive slots.
  Inputs inputs(const std::vector<std::string>& names, std::string unit, std::string doc);
  /// Ports u1, u2, …, un.
  Inputs inputs(const std::string& stem, int n, std::string unit, std::string doc);
  Outputs outputs_each(const std::string& stem, int n, std::string unit, std::string doc);
  /// One port of n elements, named 1 … n.
  Inputs input_vector(std::string name, int n, std::string unit, std::string doc);
  Outputs output_vector(std::string name, int n, std::string unit, std::string doc);
  Pose<Input> input_pose(std::string name, std::string doc);
  Pose<Output> output_pose(std::string name, std::string doc);
  Pose<Output> output_pose(std::string name, Pose<State> pose, std::string doc);
  /// Of a sampled block: what it shows before the first hit (else 0).
  Pose<Output> output_pose(std::string name, Pose<Param> before_first_hit, std::string doc);

  Output output(std::string name, std::string unit, std::string doc);
  /// Of a sampled block: what it shows before the first hit (else 0).
  Output output(std::string name, std::string unit, std::string doc, Param before_first_hit);
  /// An output that is a state or a held value: same slot, no equation.
  Output output(std::string name, State x, std::string doc);
  Output output(std::string name, Held h, std::string doc);
  /// The output is the input: no equation, no copy.
  void pass(Input u, Output y);

  State state(std::string name, double initial, std::string unit, std::string doc);
  State state(std::string name, Param initial, std::string unit, std::string doc);
  States states(const std::string& stem, int n, std::string unit, std::string doc);
  /// Keeps `x` between the limits that are declared; see StateLimits for the equations that belong to it.
  StateLimits limits(State x, Param lower, Param upper);
  Held held(std::string name, double initial, std::string unit, std::string doc);
  Held held(std::string name, Param initial, std::string unit, std::string doc);
  /// stem1, stem2, …: one for each of `initial`, 0 at the start where that is not declared.
  States states(const std::string& stem, const std::vector<Param>& initial, std::string unit,
                std::string doc);
  Helds helds(const std::string& stem, const std::vector<Param>& initial, std::string unit, std::string doc);

  /// A held value that ends the run when an event sets it to 1: the instant is completed, then the run ends
  /// as it would at its stop time, or with an error. `reason` is shown, with the name of the block.
  Held run_end(std::string name, RunEnd how, std::string reason);

  /// On while positive, off while negative; zero changes nothing.
  Relation relation(std::string name, std::string doc);
  Relations relations_each(const std::string& stem, int n, std::string doc);
  /// Fires `on_crossing` when its value changes sign in this direction.
  Crossing crossing(std::string name, Direction direction, std::string doc);
  /// The one time event of a block; `schedule` says when it is due, `never` if not.
  Alarm alarm(std::string name, std::string doc);

  /// The key of this instance's own random numbers, from the seed of the run and the name of the instance:
  /// for `normal` and `uniform` in blocks/random.h. Nothing may set it.
  Param random_stream();

  /// Makes the block sampled: keys `sample_time` and `offset`, exact.
  SampleTime sample_time(Rational fallback = Rational(1));
  /// Makes the block sampled where the model gives a `sample_time`; else it answers at all times.
  SampleTime sample_time_if_given();

  // Declared only where the structure asks for it; the handle is else `declared() == false`.
  Param param_if(bool wanted, std::string name, double fallback, std::string unit, Range range,
                 std::string doc);
  Input input_if(bool wanted, std::string name, std::string unit, std::string doc);
  Held held_if(bool wanted, std::string name, double initial, std::string unit, std::string doc);
  Relation relation_if(bool wanted, std::string name, std::string doc);
  Crossing crossing_if(bool wanted, std::string name, Direction direction, std::string doc);

  template <class O>
  ObjectInput<O> object_input(std::string name, std::string doc) {
    return {object_slot<O>(SlotKind::object_input, std::move(name), std::move(doc))};
  }
  template <class O>
  ObjectOutput<O> object_output(std::string name, std::string doc) {
    return {object_slot<O>(SlotKind::object_output, std::move(name), std::move(doc))};
  }
  /// An output that always shows one object, which is structure: no equation.
  template <class O>
  ObjectOutput<O> object_output(std::string name, std::shared_ptr<const O> object, std::string doc) {
    const ObjectOutput<O> port = object_output<O>(std::move(name), std::move(doc));
    spec_.slots[port.slot].make_object = [object] { return std::shared_ptr<const void>(object); };
    spec_.slots[port.slot].constant = true;
    return port;
  }
  template <class O>
  Memory<O> memory(std::string name, std::string doc) {
    const int slot = object_slot<O>(SlotKind::memory, std::move(name), std::move(doc));
    spec_.slots[slot].make_memory = [] { return std::any(O{}); };
    return {slot};
  }

  // Structure: what these read fixes the shape of the block.
  bool given(const std::string& key) const;
  std::string text(const std::string& key, const std::string& fallback, std::string doc);
  std::string choice(const std::string& key, const std::string& fallback, std::vector<std::string> choices,
                     std::string doc);
  /// The same as the position in `choices`, for a switch in an equation.
  int option(const std::string& key, const std::string& fallback, std::vector<std::string> choices,
             std::string doc);
  int count(const std::string& key, int fallback, int least, int most, std::string doc);
  bool flag(const std::string& key, bool fallback, std::string doc);
  std::vector<std::string> list(const std::string& key, const std::vector<std::string>& fallback,
                                std::string doc);
  /// Whole numbers from `least` to `most`.
  std::vector<int> counts(const std::string& key, const std::vector<int>& fallback, int least, int most,
                          std::string doc);
  /// Parameters key[0], key[1], … (or key[0][1], …), one for each entry that is not a literal 0, or for all.
  Coefficients coefficients(const std::string& key, const std::vector<double>& fallback, std::string unit,
                            std::string doc, Entries entries = Entries::not_zero);
  Coefficients matrix(const std::string& key, const std::vector<std::vector<double>>& fallback,
                      std::string doc, Entries entries = Entries::not_zero);
  /// Text over `inputs`; other names are parameters of the model.
  std::shared_ptr<const Formula> formula(const std::string& key, const std::string& fallback_input,
                                         const std::vector<std::string>& inputs, std::string doc);
  /// The column that key `column` names of the file that key `file` names, over the file's first column,
  /// time. At least one row.
  std::shared_ptr<const TimeSeries> time_series(const std::string& file, const std::string& column);
  /// NumberRows of lengths, m. Structure: what their expressions use is structural, too.
  NumberRows lengths(const std::string& key, const NumberRows& fallback, std::string doc);
  /// The columns `names` of the file that key `file` names, in `unit`, row by row; nothing without a file.
  std::optional<NumberRows> columns(const std::string& file, const std::vector<std::string>& names,
                                    const std::string& unit);
  /// Reports a structural mistake at `key`.
  void refuse(const std::string& key, std::string message);

 private:
  int slot(SlotSpec spec);
  SampleTime sampled(Rational fallback);
  static SlotSpec param_spec(std::string name, double fallback, std::string unit, Range range,
                             std::string doc);
  static SlotSpec state_spec(SlotKind kind, std::string name, double initial, int initial_param,
                             std::string unit, std::string doc);
  int port_slot(bool is_input, std::string name, std::string unit, std::string doc);
  int vector_port(bool is_input, std::string name, const std::vector<std::string>& elements,
                  const std::vector<std::string>& units, const std::string& doc);
  int state_slot(SlotKind kind, std::string name, double initial, int initial_param, std::string unit,
                 std::string doc);
  int state_slots(SlotKind kind, const std::string& stem, const std::vector<Param>& initial,
                  const std::string& unit, const std::string& doc);
  Output aliased(std::string name, int slot, std::string doc);
  Coefficients declare_coefficients(const std::string& key, const Shape& shape,
                                    const std::vector<double>& fallback, bool one_row, std::string unit,
                                    std::string doc);

  template <class O>
  int object_slot(SlotKind kind, std::string name, std::string doc) {
    SlotSpec spec;
    spec.kind = kind;
    spec.name = name;
    spec.doc = doc;
    spec.type = typeid(O).name();
    spec.make_object = [] { return std::shared_ptr<const void>(std::make_shared<const O>()); };
    const int at = slot(std::move(spec));
    if (kind != SlotKind::memory) {
      spec_.ports.push_back({std::move(name), std::move(doc), kind == SlotKind::object_input, {}, {at}});
    }
    return at;
  }

  Settings* settings_;
  Specification spec_;
};

}  // namespace flyball
