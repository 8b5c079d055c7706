#include "studies/metrics/measures.h"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace flyball {
namespace {

using Kind = MeasureParameter::Kind;
using Input = MeasureInput;

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

constexpr MeasureParameter of_signal{"x", Kind::signal}, of_response{"y", Kind::signal},
    of_error{"e", Kind::signal}, of_condition{"condition", Kind::condition},
    initial_level{"initial", Kind::level, false}, final_level{"final", Kind::level, false};

double first_value(const Signal& s) { return s.value.empty() ? undefined : s.value.front(); }
double last_value(const Signal& s) { return s.value.empty() ? undefined : s.value.back(); }

/// Of a response, whose parameters `initial` and `final` have these numbers.
double initial_of(const Input& in, std::size_t parameter) {
  return in.number(parameter, first_value(in.first()));
}
double final_of(const Input& in, std::size_t parameter) {
  return in.number(parameter, last_value(in.first()));
}

double overshoot_of(const Input& in) {
  return overshoot(in.first(), initial_of(in, 1), final_of(in, 2)) / 100.0;
}
double settling_of(const Input& in) {
  return settling_time(in.first(), initial_of(in, 3), final_of(in, 2), in.number(1, 0.02));
}
double rise_of(const Input& in) { return rise_time(in.first(), initial_of(in, 1), final_of(in, 2)); }
double delay_of(const Input& in) { return time_to(in.first(), initial_of(in, 1), final_of(in, 2), 0.5); }
double dead_time_of(const Input& in) {
  return time_to(in.first(), initial_of(in, 3), final_of(in, 2), in.number(1, 0.02));
}
double peak_of(const Input& in) { return peak(in.first(), initial_of(in, 1)); }
double peak_time_of(const Input& in) { return peak_time(in.first(), initial_of(in, 1)); }

double min_of(const Input& in) {
  const auto& values = in.first().value;
  return values.empty() ? undefined : *std::ranges::min_element(values);
}
double max_of(const Input& in) {
  const auto& values = in.first().value;
  return values.empty() ? undefined : *std::ranges::max_element(values);
}

std::vector<Measure> step_measures() {
  const MeasureParameter band{"band", Kind::number, false}, level{"level", Kind::number, false};
  return {
      {"overshoot",
       "how far the response goes beyond its end, as a part of its way",
       {of_response, initial_level, final_level},
       0,
       0,
       overshoot_of},
      {"settling",
       "time from which the response stays within the band (2 %, as a part of its way) around its end",
       {of_response, band, final_level, initial_level},
       0,
       1,
       settling_of},
      {"rise", "time from 10 % to 90 % of the way", {of_response, initial_level, final_level}, 0, 1, rise_of},
      {"delay", "time to 50 % of the way", {of_response, initial_level, final_level}, 0, 1, delay_of},
      {"dead_time",
       "time until the response has gone the part `level` (2 %) of its way",
       {of_response, level, final_level, initial_level},
       0,
       1,
       dead_time_of},
      {"peak", "the value farthest from the initial one", {of_response, initial_level}, 1, 0, peak_of},
      {"peak_time",
       "time to the value farthest from the initial one",
       {of_response, initial_level},
       0,
       1,
       peak_time_of},
      {"steady_state_error",
       "the reference less the response, at the end",
       {of_response, {"reference", Kind::signal}},
       1,
       0,
       [](const Input& in) { return last_value(in.signals[1]) - last_value(in.first()); },
       true},
  };
}

std::vector<Measure> integral_measures() {
  return {
      {"IAE",
       "integral of |e|",
       {of_error},
       1,
       1,
       [](const Input& in) { return integral_of_magnitude(in.first()); }},
      {"ISE",
       "integral of e^2",
       {of_error},
       2,
       1,
       [](const Input& in) { return integral_of_square(in.first()); }},
      {"ITAE",
       "integral of t |e|",
       {of_error},
       1,
       2,
       [](const Input& in) { return integral_of_time_magnitude(in.first()); }},
      {"ITSE",
       "integral of t e^2",
       {of_error},
       2,
       2,
       [](const Input& in) { return integral_of_time_square(in.first()); }},
      {"integral", "integral of x", {of_signal}, 1, 1, [](const Input& in) { return integral(in.first()); }},
      {"effort",
       "integral of x^2",
       {of_signal},
       2,
       1,
       [](const Input& in) { return integral_of_square(in.first()); }},
      {"duration",
       "how long the condition holds",
       {of_condition},
       0,
       1,
       [](const Input& in) { return integral(in.first()); }},
      {"fraction",
       "the part of the time in which the condition holds",
       {of_condition},
       0,
       0,
       [](const Input& in) { return mean(in.first()); }},
  };
}

std::vector<Measure> value_measures() {
  return {
      {"mean", "mean over time", {of_signal}, 1, 0, [](const Input& in) { return mean(in.first()); }},
      {"rms",
       "root of the mean square over time",
       {of_signal},
       1,
       0,
       [](const Input& in) { return root_mean_square(in.first()); }},
      {"min", "least value", {of_signal}, 1, 0, min_of},
      {"max", "largest value", {of_signal}, 1, 0, max_of},
      {"initial",
       "value at the start",
       {of_signal},
       1,
       0,
       [](const Input& in) { return first_value(in.first()); }},
      {"final",
       "value at the end",
       {of_signal},
       1,
       0,
       [](const Input& in) { return last_value(in.first()); },
       true},
      {"at",
       "value at a time; behind a jump there",
       {of_signal, {"time", Kind::time}},
       1,
       0,
       [](const Input& in) { return value_at(in.first(), in.numbers[1]); }},
      {"total_variation",
       "sum of all moves up and down",
       {of_signal},
       1,
       0,
       [](const Input& in) { return total_variation(in.first()); }},
      {"crossings",
       "how often x changes its sign",
       {of_signal},
       0,
       0,
       [](const Input& in) { return crossings(in.first()); }},
      {"path_length",
       "length of the way of the point (x, y)",
       {of_signal, {"y", Kind::signal}},
       1,
       0,
       [](const Input& in) { return path_length(in.first(), in.signals[1]); }},
  };
}

std::vector<Measure> statistics_measures() {
  const auto of = [](std::string_view name, std::string_view doc, double (*value)(const Input&)) {
    return Measure{name, doc, {}, 0, 0, value};
  };
  return {
      of("steps", "accepted steps of the solver",
         [](const Input& in) { return static_cast<double>(in.statistics->stepper.steps); }),
      of("rejected", "rejected steps",
         [](const Input& in) { return static_cast<double>(in.statistics->stepper.rejected); }),
      of("evaluations", "evaluations of the rates",
         [](const Input& in) { return static_cast<double>(in.statistics->stepper.rate_evaluations); }),
      of("hits", "instants with a sampled block",
         [](const Input& in) { return static_cast<double>(in.statistics->hits); }),
      of("alarms", "alarms that rang",
         [](const Input& in) { return static_cast<double>(in.statistics->alarms); }),
      of("events", "relations and crossings that fired",
         [](const Input& in) { return static_cast<double>(in.statistics->events); }),
  };
}

double wrapped(double angle) { return std::remainder(angle, 2.0 * M_PI); }

std::vector<double> wrapped_signal(const Input& in) {
  std::vector<double> result;
  for (const double angle : in.first().value) result.push_back(wrapped(angle));
  return result;
}

std::vector<double> heading_error(const Input& in) {
  std::vector<double> result;
  for (std::size_t k = 0; k < in.first().value.size(); ++k)
    result.push_back(wrapped(in.first().value[k] - in.signals[1].value[k]));
  return result;
}

std::vector<double> cross_track(const Input& in) {
  std::vector<double> result;
  for (std::size_t k = 0; k < in.first().value.size(); ++k) {
    const Point at{in.first().value[k], in.signals[1].value[k]};
    result.push_back(in.signals.size() < 3 ? distance(at, *in.path)
                                           : segment_distance(at, in.path->leg(in.signals[2].value[k])));
  }
  return result;
}

std::vector<double> line_distances(const Input& in) {
  std::vector<double> result;
  for (std::size_t k = 0; k < in.first().value.size(); ++k) {
    const Point at{in.first().value[k], in.signals[1].value[k]};
    result.push_back(line_distance(at, in.path->leg(in.signals[2].value[k])));
  }
  return result;
}

/// Signals that are made of signals.
std::vector<Measure> signal_functions() {
  const MeasureParameter y{"y", Kind::signal}, path{"path", Kind::path}, angle{"angle", Kind::plain};
  const auto of = [](std::string_view name, std::string_view doc, std::vector<MeasureParameter> parameters,
                     int power, std::vector<double> (*series)(const Input&)) {
    return Measure{name, doc, std::move(parameters), power, 0, nullptr, false, series};
  };
  return {
      of("wrap", "the angle between -pi and pi", {angle}, 0, wrapped_signal),
      of("heading_error", "the heading less the reference, between -pi and pi",
         {{"heading", Kind::plain}, {"reference", Kind::plain}}, 0, heading_error),
      of("cross_track",
         "distance of the point (x, y) from the path; with `index`, from its leg that ends in that point",
         {of_signal, y, path, {"index", Kind::plain, false}}, 1, cross_track),
      of("line_distance",
         "distance from the infinite line through the leg of the path that ends in point `index`",
         {of_signal, y, path, {"index", Kind::plain}}, 1, line_distances),
  };
}

}  // namespace

std::string Measure::signature() const {
  std::string text(name);
  text += '(';
  bool optional = false;
  for (const MeasureParameter& parameter : parameters) {
    if (!parameter.required && !optional) text += '[';
    optional = optional || !parameter.required;
    if (&parameter != parameters.data()) text += ", ";
    text += parameter.name;
  }
  return text + (optional ? "])" : ")");
}

const std::vector<Measure>& measures() {
  static const std::vector<Measure> all = [] {
    std::vector<Measure> result;
    for (const auto& group : {step_measures(), integral_measures(), value_measures(), signal_functions(),
                              statistics_measures()}) {
      result.insert(result.end(), group.begin(), group.end());
    }
    return result;
  }();
  return all;
}

const Measure* find_measure(std::string_view name) {
  const auto same_letter = [](unsigned char a, unsigned char b) {
    return std::tolower(a) == std::tolower(b);
  };
  const auto found = std::ranges::find_if(measures(), [&](const Measure& measure) {
    return std::ranges::equal(measure.name, name, same_letter);
  });
  return found == measures().end() ? nullptr : &*found;
}

}  // namespace flyball
