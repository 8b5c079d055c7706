#include "tests/contracts/cases.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "tests/blocks/formulas.h"

namespace flyball::test {
namespace {

using namespace std::string_literals;

std::vector<Case> function_cases() {
  std::vector<Case> all;
  for (const char* function : {"cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "atan2"}) {
    // asin and acos end at 1, tan at pi/2.
    all.push_back({"TrigonometricFunction", function, {{"function", std::string(function)}}, {0.9}});
  }
  for (const char* function :
       {"log", "10^u", "log10", "square", "sqrt", "reciprocal", "pow", "hypot", "rem", "mod"}) {
    const bool positive =
        function == "log"s || function == "log10"s || function == "sqrt"s || function == "pow"s;
    all.push_back({"MathFunction", function, {{"function", std::string(function)}}, {2.0, positive}});
  }
  all.push_back({"Divide", "a divisor that jumps", {{"divisor_jumps", true}}});
  all.push_back({"MinMax", "greatest of four", {{"function", "max"s}, {"inputs", 4.0}}});
  all.push_back({"MinMax", "one", {{"inputs", 1.0}}});
  all.push_back({"Sum", "five terms", {{"signs", "+-+--"s}}});
  all.push_back({"Sum", "one term", {{"signs", "-"s}}});
  all.push_back({"Product", "divisors", {{"signs", "/*/"s}}});
  all.push_back({"Expression", "a kink", {{"inputs", Words{"u", "w"}}, {"formula", example_formula()}}});
  all.push_back({"Expression", "branches", {{"inputs", Words{"u", "w"}}, {"formula", branching_formula()}}});
  all.push_back({"Expression", "parameters", {{"inputs", Words{"w"}}, {"formula", example_formula()}}});
  for (const char* op : {"NAND", "OR", "NOR", "XOR", "NXOR", "NOT"}) {
    all.push_back({"LogicalOperator", op, {{"operator", std::string(op)}}});
  }
  all.push_back({"LogicalOperator", "three", {{"operator", "XOR"s}, {"inputs", 3.0}}});
  for (const char* op : {"==", "~=", "<", ">=", ">"}) {
    all.push_back({"RelationalOperator", op, {{"operator", std::string(op)}}});
  }
  all.push_back({"HitCrossing", "rising", {{"direction", "rising"s}}});
  all.push_back({"HitCrossing", "falling", {{"direction", "falling"s}}});
  all.push_back({"Mux", "five", {{"inputs", 5.0}}});
  all.push_back({"Demux", "one", {{"outputs", 1.0}}});
  all.push_back({"Selector", "two of three", {{"width", 3.0}, {"indices", Numbers{3.0, 1.0}}}});
  return all;
}

std::vector<Case> continuous_cases() {
  return {
      {"Integrator", "lower limit", {{"lower", -1.0}}},
      {"Integrator", "upper limit", {{"upper", 1.0}}},
      {"Integrator", "limits and reset", {{"lower", -1.0}, {"upper", 1.0}, {"reset", "rising"s}}},
      {"Integrator", "falling reset", {{"reset", "falling"s}}},
      {"Integrator", "either reset", {{"reset", "either"s}}},
      {"TransferFcn", "second order", {{"numerator", Numbers{1.0}}, {"denominator", Numbers{1.0, 2.0, 5.0}}}},
      {"TransferFcn",
       "biproper",
       {{"numerator", Numbers{2.0, 0.0, 1.0}}, {"denominator", Numbers{3.0, 0.0, 5.0}}}},
      {"TransferFcn",
       "leading zeros",
       {{"numerator", Numbers{0.0, 0.0, 0.0, 4.0, 1.0}}, {"denominator", Numbers{1.0, 2.0, 0.0, 5.0}}}},
      {"TransferFcn", "order 0", {{"numerator", Numbers{2.0}}, {"denominator", Numbers{4.0}}}},
      {"ZeroPole",
       "fifth order",
       {{"zeros", Numbers{-1.0}},
        {"complex_zeros", Table{{-1.0, 2.0}}},
        {"poles", Numbers{-1.0, -2.0, -3.0}},
        {"complex_poles", Table{{-1.0, 3.0}}}}},
      {"ZeroPole", "a zero between pairs", {{"zeros", Numbers{-1.0}}, {"complex_poles", Table{{-1.0, 3.0}}}}},
      {"StateSpace",
       "two by two",
       {{"A", Table{{0.0, 1.0}, {-2.0, -3.0}}},
        {"B", Table{{1.0, 0.0}, {0.5, 1.0}}},
        {"C", Table{{1.0, 0.0}, {0.0, 1.0}, {1.0, 1.0}}},
        {"D", Table{{0.0, 0.0}, {1.0, 0.0}, {0.0, 2.0}}},
        {"initial", Numbers{0.0, 3.0}}}},
      {"StateSpace",
       "no feedthrough",
       {{"A", Table{{0.0, 1.0}, {-2.0, -3.0}}},
        {"B", Table{{0.0}, {1.0}}},
        {"C", Table{{1.0, 0.0}, {0.0, 1.0}}}}},
  };
}

std::vector<Case> source_cases() {
  const auto rows =
      std::make_shared<const TimeSeries>(TimeSeries{"m", {0.5, 1.5, 1.5, 2.0}, {1.0, 3.0, -1.0, 2.0}});
  std::vector<Case> all{{"RepeatingSequence", "hold", {{"interpolation", "hold"s}}}};
  for (const char* outside : {"hold", "linear", "zero"}) {
    all.push_back({"FromFile",
                   outside,
                   {{"file", rows}, {"before", std::string(outside)}, {"after", std::string(outside)}}});
  }
  all.push_back({"FromFile", "steps", {{"file", rows}, {"interpolation", "hold"s}}});
  return all;
}

std::vector<Case> sampled_cases() {
  const Rational tenth = *Rational::fraction(1, 10);
  std::vector<Case> all{
      {"Delay",
       "initial values",
       {{"sample_time", tenth}, {"length", 3.0}, {"initial_values", Numbers{1.0, 0.0, 2.0}}}},
      {"DiscreteTransferFcn",
       "second order",
       {{"sample_time", tenth}, {"numerator", Numbers{2.0, 1.0}}, {"denominator", Numbers{1.0, 0.0, 0.5}}}},
      {"DiscreteTransferFcn",
       "biproper",
       {{"sample_time", tenth}, {"numerator", Numbers{2.0, 1.0}}, {"denominator", Numbers{3.0, 1.0}}}},
      {"DiscreteStateSpace",
       "two inputs",
       {{"sample_time", tenth},
        {"A", Table{{0.0, 1.0}, {-0.5, 0.2}}},
        {"B", Table{{1.0, 0.0}, {0.5, 1.0}}},
        {"C", Table{{1.0, 2.0}}},
        {"D", Table{{0.0, 3.0}}},
        {"initial", Numbers{0.0, 3.0}}}},
      {"Counter", "reset", {{"reset", true}, {"direction", "either"s}}},
  };
  for (const char* method : {"forward", "backward", "trapezoidal"}) {
    const Keys keys{{"sample_time", tenth}, {"method", std::string(method)}};
    for (const char* reset : {"rising", "falling", "either"}) {
      Keys more{{"reset", std::string(reset)}, {"lower", -1.0}, {"upper", 1.0}};
      more.insert(keys.begin(), keys.end());
      all.push_back({"DiscreteTimeIntegrator", method + ", reset "s + reset, more});
    }
    all.push_back({"DiscreteTimeIntegrator", method, keys});
  }
  return all;
}

std::vector<Case> table_cases() {
  std::vector<Case> all;
  for (const char* type : {"LookupTable1D", "LookupTable2D"}) {
    for (const char* method : {"nearest", "flat"})
      all.push_back({type, method, {{"method", std::string(method)}}});
    all.push_back({type, "clip", {{"extrapolation", "clip"s}}});
  }
  all.push_back({"LookupTable1D", "two", {{"breakpoints", Numbers{0.0, 2.0}}, {"table", Numbers{5.0, 0.0}}}});
  return all;
}

std::vector<Case> controller_cases() {
  std::vector<Case> all;
  for (const char* type : {"PID", "DiscretePID"}) {
    const Keys sampled = type == "DiscretePID"s ? Keys{{"sample_time", *Rational::fraction(1, 100)}} : Keys{};
    for (const bool two : {false, true}) {
      for (const char* windup : {"none", "clamping", "back_calculation"}) {
        Keys keys{
            {"lower", -1.0}, {"upper", 1.0}, {"setpoint_weights", two}, {"anti_windup", std::string(windup)}};
        keys.insert(sampled.begin(), sampled.end());
        all.push_back({type, windup + (two ? ", two inputs"s : ""s), keys});
      }
    }
  }
  for (const char* type : {"PID", "DiscretePID"}) {
    Keys keys{{"manual_mode", true}, {"feed_forward", true}, {"anti_windup", "tracking"s}};
    if (type == "DiscretePID"s) keys.insert({"sample_time", *Rational::fraction(1, 100)});
    for (const char* form : {"parallel", "ideal", "series"}) {
      keys.insert_or_assign("form", std::string(form));
      all.push_back({type, form, keys});
    }
  }
  all.push_back(
      {"DiscretePID",
       "series, filtered",
       {{"sample_time", *Rational::fraction(1, 3)}, {"form", "series"s}, {"derivative", "filtered"s}}});
  for (const char* rule : {"forward", "trapezoidal"}) {
    all.push_back({"DiscretePID",
                   rule,
                   {{"sample_time", *Rational::fraction(1, 3)},
                    {"integral", std::string(rule)},
                    {"derivative", "filtered"s}}});
  }
  return all;
}

/// Lines have two ends, circles and landmarks are elsewhere, distances are within that of the approach.
Domain domain_of(const std::string& type) {
  const Range far{3.0, 5.0}, large{10.0, 20.0};
  if (type == "TrigonometricFunction") return {0.9};
  // Slow enough for a difference quotient of its phase, which grows with the square of time.
  if (type == "Chirp") return {0.1};
  if (type == "LandmarkSensor") return {2.0, false, {{"landmark_x", far}}};
  if (type == "LineNavigation") return {2.0, false, {{"x2", far}, {"approach_distance", large}}};
  if (type == "ArcNavigation") return {2.0, false, {{"centre_x", far}, {"approach_distance", large}}};
  if (type == "PathSequencer") return {2.0, false, {{"end_x[0]", far}, {"end_x[1]", far}, {"end_x[2]", far}}};
  if (type == "PurePursuit") return {2.0, false, {{"lookahead", far}}};
  if (type == "Stanley") return {2.0, false, {{"v", far}}};
  return {};
}

std::vector<Case> robot_cases() {
  std::vector<Case> all;
  const auto add = [&](const std::string& type, const std::string& label, Keys keys) {
    if (type != "LandmarkCorrection") keys.insert({"sample_time", *Rational::fraction(1, 100)});
    all.push_back({type, label, std::move(keys), domain_of(type)});
  };
  // Forward speed outweighs the rest, whatever the bits of the signs say.
  all.push_back({"MecanumInverse",
                 "limit",
                 {{"limit", 5.0}},
                 {2.0, false, {{"vx", {30.0, 50.0}}, {"roller_angle", {0.7, 0.9}}}}});
  add("PoseIntegrator", "midpoint", {{"method", "midpoint"s}});
  add("PoseIntegrator", "sideways, by Euler", {{"method", "euler"s}, {"sideways", true}});
  add("Encoder", "with fractions", {{"quantised", false}});
  add("EncoderOdometry", "gyro", {{"heading", "gyro"s}, {"corrected", true}});
  add("EncoderOdometry", "complementary", {{"heading", "complementary"s}});
  for (const char* convention : {"ahead", "behind", "printed"})
    add("LandmarkCorrection", convention, {{"convention", std::string(convention)}});
  add("LineNavigation", "old law", {{"law", "old"s}});
  add("ArcNavigation", "old law", {{"law", "old"s}});
  add("DeviationPID", "limits", {{"sum_limit", 0.7}, {"limit", 1.3}});
  add("DeviationPID", "printed", {{"integral", "printed"s}});
  const Numbers three{1.0, 2.0, 3.0};
  add("PathSequencer", "three parts",
      {{"parts", 3.0}, {"end_x", three}, {"end_y", three}, {"end_theta", three}, {"curvature", three}});
  return all;
}

}  // namespace

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const BlockType& type : catalogue()) {
    all.push_back({type.name, "default", {}, domain_of(type.name)});
  }
  for (auto more : {function_cases(), continuous_cases(), source_cases(), sampled_cases(), table_cases(),
                    controller_cases(), robot_cases()}) {
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
}

// splitmix64, Steele, Lea & Flood 2014.
std::uint64_t Random::word() {
  std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

double Random::uniform(double lower, double upper) {
  return lower + (upper - lower) * std::ldexp(static_cast<double>(word() >> 11), -53);
}

double draw(const SlotSpec& slot, const Domain& domain, Random& random) {
  if (slot.kind == SlotKind::time) return random.uniform(0.0, 5.0);
  if (slot.kind == SlotKind::held && random.word() % 3 == 0) return 0.0;
  const auto narrower = domain.within.find(slot.name);
  const Range& range = narrower == domain.within.end() ? slot.range : narrower->second;
  const bool bounded_below = std::isfinite(range.lower), bounded_above = std::isfinite(range.upper);
  if (!bounded_below && !bounded_above) {
    // Divisors stay a tenth of the span away from 0, so that difference quotients are meaningful.
    const double size = random.uniform(0.1 * domain.span, domain.span);
    return domain.positive ? size : std::copysign(size, random.uniform(-1.0, 1.0));
  }
  const double lower = bounded_below ? range.lower : range.upper - 3.0;
  const double upper = bounded_above ? range.upper : lower + 3.0;
  // As far from the ends, which a difference quotient must not pass.
  return random.uniform(lower + 0.1 * (upper - lower), upper - 0.1 * (upper - lower));
}

void draw_all(Bench<double>& bench, const Domain& domain, Random& random) {
  for (std::size_t at = 0; at < bench.values.size(); ++at) {
    const SlotSpec& slot = bench.spec().slots[at % bench.size()];
    bench.values[at] = draw(slot, domain, random);
    if (slot.exceeds >= 0) {
      const std::size_t below = at - at % bench.size() + slot.exceeds;
      bench.values[at] = bench.values[below] + random.uniform(0.2 * domain.span, domain.span);
    }
    bench.bits[at] = random.word() % 2;
  }
}

bool Result::writes(SlotKind kind) const {
  return (phase == Phase::outputs && kind == SlotKind::output) ||
         (phase == Phase::crossings && kind == SlotKind::crossing) ||
         (phase == Phase::schedule && kind == SlotKind::alarm);
}

std::string Result::name(const Specification& spec) const {
  const std::string slot_name = spec.slots[slot].name;
  if (phase == Phase::rates) return "rate of " + slot_name;
  if (phase == Phase::crossing) return "next " + slot_name + " at crossing " + spec.slots[crossing].name;
  return is_handler(phase) ? "next " + slot_name : slot_name;
}

std::vector<Result> results(const Specification& spec, bool handlers) {
  std::vector<Result> all;
  for (int s = 0; s < static_cast<int>(spec.slots.size()); ++s) {
    const SlotKind kind = spec.slots[s].kind;
    const bool passed = std::ranges::find(spec.passed, s, &PassThrough::output) != spec.passed.end();
    if (kind == SlotKind::output && !passed) all.push_back({Phase::outputs, -1, s});
    if (kind == SlotKind::state) all.push_back({Phase::rates, -1, s});
    if (kind == SlotKind::relation) all.push_back({Phase::relations, -1, s});
    if (kind == SlotKind::crossing) all.push_back({Phase::crossings, -1, s});
    if (kind == SlotKind::alarm) all.push_back({Phase::schedule, -1, s});
    if (!handlers || (kind != SlotKind::state && kind != SlotKind::held)) continue;
    if (spec.sampled()) all.push_back({Phase::sample, -1, s});
    if (spec.has(SlotKind::alarm)) all.push_back({Phase::time, -1, s});
    for (int c = 0; c < static_cast<int>(spec.slots.size()); ++c) {
      if (spec.slots[c].kind == SlotKind::crossing) all.push_back({Phase::crossing, c, s});
    }
  }
  return all;
}

bool same(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

}  // namespace flyball::test
