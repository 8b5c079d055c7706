#include "blocks/block.h"

#include <fmt/format.h>

namespace flyball {

Block::Block(Settings* settings) : settings_(settings) {
  SlotSpec time;
  time.name = "time";
  time.unit = "s";
  time.doc = "time";
  slot(std::move(time));
}

int Block::slot(SlotSpec spec) {
  spec_.slots.push_back(std::move(spec));
  return static_cast<int>(spec_.slots.size()) - 1;
}

SlotSpec Block::param_spec(std::string name, double fallback, std::string unit, Range range,
                           std::string doc) {
  SlotSpec spec;
  spec.kind = SlotKind::param;
  spec.setting = name;
  spec.name = std::move(name);
  spec.unit = std::move(unit);
  spec.doc = std::move(doc);
  spec.fallback = fallback;
  spec.range = range;
  return spec;
}

Param Block::param(std::string name, double fallback, std::string unit, Range range, std::string doc) {
  return {slot(param_spec(std::move(name), fallback, std::move(unit), range, std::move(doc)))};
}

Param Block::reference(const std::string& name) {
  SlotSpec spec;
  spec.kind = SlotKind::param;
  spec.name = name;
  spec.reference = name;
  spec.unit = "any";
  spec.doc = "parameter of the model";
  return {slot(std::move(spec))};
}

int Block::port_slot(bool is_input, std::string name, std::string unit, std::string doc) {
  SlotSpec spec;
  spec.kind = is_input ? SlotKind::input : SlotKind::output;
  spec.name = name;
  spec.unit = std::move(unit);
  spec.doc = doc;
  const int at = slot(std::move(spec));
  spec_.ports.push_back({std::move(name), std::move(doc), is_input, {}, {at}});
  return at;
}

Input Block::input(std::string name, std::string unit, std::string doc) {
  return {port_slot(true, std::move(name), std::move(unit), std::move(doc))};
}

Input Block::input(std::string name, std::string unit, std::string doc, double fallback) {
  const Input u = input(std::move(name), std::move(unit), std::move(doc));
  spec_.slots[u.slot].optional = true;
  spec_.slots[u.slot].fallback = fallback;
  return u;
}

Inputs Block::inputs(const std::vector<std::string>& names, std::string unit, std::string doc) {
  const int first = static_cast<int>(spec_.slots.size());
  for (const std::string& name : names) port_slot(true, name, unit, doc);
  return {first, static_cast<int>(names.size())};
}

Inputs Block::inputs(const std::string& stem, int n, std::string unit, std::string doc) {
  const int first = static_cast<int>(spec_.slots.size());
  for (int k = 1; k <= n; ++k) port_slot(true, fmt::format("{}{}", stem, k), unit, doc);
  return {first, n};
}

Outputs Block::outputs_each(const std::string& stem, int n, std::string unit, std::string doc) {
  const int first = static_cast<int>(spec_.slots.size());
  for (int k = 1; k <= n; ++k) port_slot(false, fmt::format("{}{}", stem, k), unit, doc);
  return {first, n};
}

int Block::vector_port(bool is_input, std::string name, const std::vector<std::string>& elements,
                       const std::vector<std::string>& units, const std::string& doc) {
  const int first = static_cast<int>(spec_.slots.size());
  PortSpec port{name, doc, is_input, elements, {}};
  for (std::size_t k = 0; k < elements.size(); ++k) {
    SlotSpec spec;
    spec.kind = is_input ? SlotKind::input : SlotKind::output;
    spec.name = fmt::format("{}.{}", name, elements[k]);
    spec.unit = units[k];
    spec.doc = doc;
    port.slots.push_back(slot(std::move(spec)));
  }
  spec_.ports.push_back(std::move(port));
  return first;
}

namespace {

std::vector<std::string> numbers_up_to(int n) {
  std::vector<std::string> result;
  for (int k = 1; k <= n; ++k) result.push_back(std::to_string(k));
  return result;
}

const std::vector<std::string> pose_elements{"x", "y", "theta"};
const std::vector<std::string> pose_units{"m", "m", "rad"};

}  // namespace

Inputs Block::input_vector(std::string name, int n, std::string unit, std::string doc) {
  return {vector_port(true, std::move(name), numbers_up_to(n), std::vector<std::string>(n, unit), doc), n};
}

Outputs Block::output_vector(std::string name, int n, std::string unit, std::string doc) {
  return {vector_port(false, std::move(name), numbers_up_to(n), std::vector<std::string>(n, unit), doc), n};
}

Pose<Input> Block::input_pose(std::string name, std::string doc) {
  const int first = vector_port(true, std::move(name), pose_elements, pose_units, doc);
  return {{first}, {first + 1}, {first + 2}};
}

Pose<Output> Block::output_pose(std::string name, std::string doc) {
  const int first = vector_port(false, std::move(name), pose_elements, pose_units, doc);
  return {{first}, {first + 1}, {first + 2}};
}

Pose<Output> Block::output_pose(std::string name, Pose<State> pose, std::string doc) {
  spec_.ports.push_back(
      {std::move(name), std::move(doc), false, pose_elements, {pose.x.slot, pose.y.slot, pose.theta.slot}});
  return {{pose.x.slot}, {pose.y.slot}, {pose.theta.slot}};
}

Pose<Output> Block::output_pose(std::string name, Pose<Param> before_first_hit, std::string doc) {
  const Pose<Output> pose = output_pose(std::move(name), std::move(doc));
  spec_.slots[pose.x.slot].initial_param = before_first_hit.x.slot;
  spec_.slots[pose.y.slot].initial_param = before_first_hit.y.slot;
  spec_.slots[pose.theta.slot].initial_param = before_first_hit.theta.slot;
  return pose;
}

Output Block::output(std::string name, std::string unit, std::string doc) {
  return {port_slot(false, std::move(name), std::move(unit), std::move(doc))};
}

Output Block::output(std::string name, std::string unit, std::string doc, Param before_first_hit) {
  const Output y = output(std::move(name), std::move(unit), std::move(doc));
  spec_.slots[y.slot].initial_param = before_first_hit.slot;
  return y;
}

Output Block::aliased(std::string name, int slot, std::string doc) {
  spec_.ports.push_back({std::move(name), std::move(doc), false, {}, {slot}});
  return {slot};
}

Output Block::output(std::string name, State x, std::string doc) {
  return aliased(std::move(name), x.slot, std::move(doc));
}

Output Block::output(std::string name, Held h, std::string doc) {
  return aliased(std::move(name), h.slot, std::move(doc));
}

void Block::pass(Input u, Output y) { spec_.passed.push_back({y.slot, u.slot}); }

SlotSpec Block::state_spec(SlotKind kind, std::string name, double initial, int initial_param,
                           std::string unit, std::string doc) {
  SlotSpec spec;
  spec.kind = kind;
  spec.name = std::move(name);
  spec.unit = std::move(unit);
  spec.doc = std::move(doc);
  spec.fallback = initial;
  spec.initial_param = initial_param;
  return spec;
}

int Block::state_slot(SlotKind kind, std::string name, double initial, int initial_param, std::string unit,
                      std::string doc) {
  return slot(state_spec(kind, std::move(name), initial, initial_param, std::move(unit), std::move(doc)));
}

State Block::state(std::string name, double initial, std::string unit, std::string doc) {
  return {state_slot(SlotKind::state, std::move(name), initial, -1, std::move(unit), std::move(doc))};
}

State Block::state(std::string name, Param initial, std::string unit, std::string doc) {
  return {state_slot(SlotKind::state, std::move(name), 0, initial.slot, std::move(unit), std::move(doc))};
}

States Block::states(const std::string& stem, int n, std::string unit, std::string doc) {
  return states(stem, std::vector<Param>(n), std::move(unit), std::move(doc));
}

int Block::state_slots(SlotKind kind, const std::string& stem, const std::vector<Param>& initial,
                       const std::string& unit, const std::string& doc) {
  if (initial.empty()) spec_.absent.push_back(state_spec(kind, stem, 0.0, -1, unit, doc));
  const int first = static_cast<int>(spec_.slots.size());
  for (std::size_t k = 0; k < initial.size(); ++k)
    state_slot(kind, fmt::format("{}{}", stem, k + 1), 0.0, initial[k].slot, unit, doc);
  return first;
}

States Block::states(const std::string& stem, const std::vector<Param>& initial, std::string unit,
                     std::string doc) {
  return {state_slots(SlotKind::state, stem, initial, unit, doc), static_cast<int>(initial.size())};
}

Helds Block::helds(const std::string& stem, const std::vector<Param>& initial, std::string unit,
                   std::string doc) {
  return {state_slots(SlotKind::held, stem, initial, unit, doc), static_cast<int>(initial.size())};
}

StateLimits Block::limits(State x, Param lower, Param upper) {
  const bool low = lower.declared(), high = upper.declared();
  return {x,
          lower,
          upper,
          relation_if(low, "at_lower", "the state is at its lower limit"),
          relation_if(high, "at_upper", "the state is at its upper limit"),
          relation_if(low || high, "growing", "the state grows where no limit holds it"),
          crossing_if(low, "meets_lower", Direction::falling, "the state meets its lower limit"),
          crossing_if(high, "meets_upper", Direction::rising, "the state meets its upper limit")};
}

Held Block::held(std::string name, double initial, std::string unit, std::string doc) {
  return {state_slot(SlotKind::held, std::move(name), initial, -1, std::move(unit), std::move(doc))};
}

Held Block::held(std::string name, Param initial, std::string unit, std::string doc) {
  return {state_slot(SlotKind::held, std::move(name), 0, initial.slot, std::move(unit), std::move(doc))};
}

Held Block::run_end(std::string name, RunEnd how, std::string reason) {
  const Held end = held(std::move(name), 0.0, "1", std::move(reason));
  spec_.slots[end.slot].end = how;
  return end;
}

Param Block::random_stream() {
  const Param stream = param("stream", 0.0, "1", any, "stream of random numbers");
  spec_.slots[stream.slot].fixed = true;
  spec_.slots[stream.slot].stream = true;
  return stream;
}

Relation Block::relation(std::string name, std::string doc) {
  return {state_slot(SlotKind::relation, std::move(name), 0, -1, "any", std::move(doc))};
}

Relations Block::relations_each(const std::string& stem, int n, std::string doc) {
  if (n == 0) spec_.absent.push_back(state_spec(SlotKind::relation, stem, 0.0, -1, "any", doc));
  const int first = static_cast<int>(spec_.slots.size());
  for (int k = 1; k <= n; ++k) relation(fmt::format("{}{}", stem, k), doc);
  return {first, n};
}

Crossing Block::crossing(std::string name, Direction direction, std::string doc) {
  const int at = state_slot(SlotKind::crossing, std::move(name), 0, -1, "any", std::move(doc));
  spec_.slots[at].direction = direction;
  return {at};
}

Alarm Block::alarm(std::string name, std::string doc) {
  return {state_slot(SlotKind::alarm, std::move(name), 0, -1, "s", std::move(doc))};
}

Param Block::param_if(bool wanted, std::string name, double fallback, std::string unit, Range range,
                      std::string doc) {
  if (wanted) return param(std::move(name), fallback, std::move(unit), range, std::move(doc));
  spec_.absent.push_back(param_spec(std::move(name), fallback, std::move(unit), range, std::move(doc)));
  return {};
}

Input Block::input_if(bool wanted, std::string name, std::string unit, std::string doc) {
  if (wanted) return input(std::move(name), std::move(unit), std::move(doc));
  SlotSpec& absent = spec_.absent.emplace_back();
  absent.kind = SlotKind::input;
  absent.name = std::move(name);
  absent.unit = std::move(unit);
  absent.doc = std::move(doc);
  return {};
}

Held Block::held_if(bool wanted, std::string name, double initial, std::string unit, std::string doc) {
  if (wanted) return held(std::move(name), initial, std::move(unit), std::move(doc));
  spec_.absent.push_back(
      state_spec(SlotKind::held, std::move(name), initial, -1, std::move(unit), std::move(doc)));
  return {};
}

Relation Block::relation_if(bool wanted, std::string name, std::string doc) {
  if (wanted) return relation(std::move(name), std::move(doc));
  spec_.absent.push_back(state_spec(SlotKind::relation, std::move(name), 0.0, -1, "any", std::move(doc)));
  return {};
}

Crossing Block::crossing_if(bool wanted, std::string name, Direction direction, std::string doc) {
  if (wanted) return crossing(std::move(name), direction, std::move(doc));
  SlotSpec absent = state_spec(SlotKind::crossing, std::move(name), 0.0, -1, "any", std::move(doc));
  absent.direction = direction;
  spec_.absent.push_back(std::move(absent));
  return {};
}

}  // namespace flyball
