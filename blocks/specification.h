#pragma once

#include <any>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "blocks/formula.h"
#include "blocks/rational.h"

namespace flyball {

/// The values that a parameter may take. Ends belong to the range unless `open`.
struct Range {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool lower_open = false;
  bool upper_open = false;

  bool contains(double x) const {
    return (lower_open ? x > lower : x >= lower) && (upper_open ? x < upper : x <= upper);
  }
};

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr Range any{};
inline constexpr Range positive{0.0, infinity, true};
inline constexpr Range non_negative{0.0, infinity};
inline constexpr Range unit_interval{0.0, 1.0};

/// Which change of sign fires a crossing.
enum class Direction { rising, falling, either };

/// What it means for the run when a held value is no longer 0 after an instant.
enum class RunEnd { none, normal, error };

/// Which entries of a list or table of numbers become parameters: those that are not the literal 0, all, or
/// all with each above the one before.
enum class Entries { not_zero, all, increasing };

enum class SlotKind {
  time,
  param,
  input,
  output,
  state,
  held,
  relation,
  crossing,
  alarm,
  object_input,
  object_output,
  memory
};

/// One number of a block: what its declaration said. Slot 0 of every block is time.
struct SlotSpec {
  SlotKind kind = SlotKind::time;
  std::string name;  // a port's element is "port.element"
  std::string unit;  // "any" where the equations decide
  std::string doc;
  double fallback = 0.0;   // default of a parameter or an optional input, initial value of a state
  int initial_param = -1;  // slot of the parameter that gives the initial value, instead of `fallback`
  Range range;             // of a parameter
  std::string setting;     // key that gives a parameter's value; `entry` counts in row-major order
  int entry = -1;          // -1: the key's value is the parameter itself
  int exceeds = -1;        // slot of the parameter that this one must be above
  std::string reference;   // parameter of the model that this one is bound to (a formula's free name)
  bool optional = false;   // an input that may stay unconnected
  bool fixed = false;      // a parameter that nothing may set: the sample time
  bool stream = false;     // a parameter that is the stream of random numbers of its instance
  Direction direction = Direction::either;
  RunEnd end = RunEnd::none;  // of a held value; then `doc` says why
  // Objects and memories are no numbers: their slots count in arrays of their own.
  std::string type;  // name of the C++ type; ends of a wire must agree
  std::function<std::shared_ptr<const void>()> make_object;  // the value before the first hit
  bool constant = false;                                     // of an object output: that is its value
  std::any (*make_memory)() = nullptr;

  bool numeric() const { return kind < SlotKind::object_input; }
};

/// A named end for wires: numbers, one slot an element, or one object.
struct PortSpec {
  std::string name;
  std::string doc;
  bool is_input = false;
  std::vector<std::string> elements;  // empty for a scalar port
  std::vector<int> slots;             // one, or one an element
};

/// A key that fixes the block's shape.
struct StructureSpec {
  std::string key;
  std::string fallback;  // as it would be written in a model file
  std::string doc;
  std::vector<std::string> choices;  // of an enumerated key
};

/// An output element that is an input element (Mux, Demux): no equation, no copy.
struct PassThrough {
  int output = -1;
  int input = -1;
};

/// All that a block's declarations said, in their order.
struct Specification {
  std::vector<SlotSpec> slots;  // slot 0 is time
  std::vector<PortSpec> ports;
  std::vector<StructureSpec> structure;
  std::vector<PassThrough> passed;
  std::vector<Formula::Node> literals;  // of the block's formulas, by their number
  std::vector<SlotSpec> absent;         // what other structure would declare
  std::optional<Rational> period;       // of a sampled block
  Rational offset;                      // its first hit
  bool refused = false;                 // a structural mistake was reported: the equations must not run

  bool sampled() const { return period.has_value(); }
  int count(SlotKind kind) const;
  bool has(SlotKind kind) const { return count(kind) > 0; }
  /// Whether this or another structure of the block declares the kind.
  bool may_have(SlotKind kind) const;
  const PortSpec* port(std::string_view name) const;  ///< nullptr when there is none
};

}  // namespace flyball
