#include "studies/metrics/clause.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

bool is_less(Order relation) { return relation == Order::less || relation == Order::less_equal; }
bool is_strict(Order relation) { return relation == Order::less || relation == Order::greater; }

std::string_view sign(Order relation) {
  constexpr std::array<std::string_view, 4> signs{"<", "<=", ">", ">="};
  return signs[static_cast<std::size_t>(relation)];
}

/// a < b is b > a.
Order turned(Order relation) {
  constexpr std::array<Order, 4> all{Order::greater, Order::greater_equal, Order::less, Order::less_equal};
  return all[static_cast<std::size_t>(relation)];
}

/// How a comparison turns out at one time: its tightest link.
struct Tightest {
  double margin = infinity;
  std::size_t link = 0;
  bool holds = true;
};

Tightest tightest(const std::vector<Order>& relations, auto&& side) {
  Tightest result;
  for (std::size_t k = 0; k < relations.size(); ++k) {
    const double difference = side(k + 1) - side(k);
    const double margin = is_less(relations[k]) ? difference : -difference;
    result.holds = result.holds && (is_strict(relations[k]) ? margin > 0.0 : margin >= 0.0);
    // Not `margin < result.margin`: NaN is the worst.
    if (!(margin >= result.margin)) {
      result.margin = margin;
      result.link = k;
    }
  }
  return result;
}

/// "u is 13 V at 2 s, expected <= 12 V": of a link, the side that is not a given number is what was found.
struct Found {
  const Comparison& comparison;
  const DisplayUnit& unit;
  std::size_t link;

  std::size_t subject() const { return comparison.sides[link].operands.empty() ? link + 1 : link; }
  std::size_t bound() const { return 2 * link + 1 - subject(); }

  std::string text(double value, double limit, const std::string& where) const {
    const Order relation =
        subject() == link ? comparison.relations[link] : turned(comparison.relations[link]);
    const std::string& name = comparison.side_texts[subject()];
    const std::string found = std::isnan(value) ? "has no value" : "is " + unit.shown(value);
    const bool given = comparison.sides[bound()].operands.empty();
    return fmt::format("{} {}{}, expected {} {}{}", name, found, where, sign(relation),
                       given ? "" : comparison.side_texts[bound()] + " = ", unit.shown(limit));
  }
};

Verdict check_numbers(const Comparison& comparison, const DisplayUnit& unit, const Evaluation& evaluation) {
  std::vector<double> sides;
  for (const SeriesExpression& side : comparison.sides) sides.push_back(evaluation.number(side));
  const Tightest worst = tightest(comparison.relations, [&](std::size_t k) { return sides[k]; });
  const Found found{comparison, unit, worst.link};
  const double value = sides[found.subject()];
  return {worst.holds, worst.margin, value, undefined, found.text(value, sides[found.bound()], "")};
}

/// The sides of a comparison over its window of time.
struct Sides {
  std::vector<double> time;
  std::vector<std::vector<double>> values;
};

Sides sides_over_time(const Comparison& comparison, const Evaluation& evaluation) {
  Sides sides{evaluation.time(), {}};
  for (const SeriesExpression& side : comparison.sides) sides.values.push_back(evaluation.series(side));
  const auto limit = [&](const auto& time) { return time ? evaluation.number(*time) : undefined; };
  const Window window{limit(comparison.from), limit(comparison.to)};
  // A window without an answer is none: it must not become the whole run.
  const bool none = (comparison.from && std::isnan(window.from)) || (comparison.to && std::isnan(window.to));
  if (none) return {};
  if (comparison.from || comparison.to) clip(sides.time, sides.values, window);
  return sides;
}

/// Whether a row tells more than the one before: the worst one of what must always hold, else the best one.
bool replaces(const Tightest& now, const Tightest& chosen, bool always) {
  if (std::isnan(chosen.margin)) return !always && !std::isnan(now.margin);
  return always ? !(now.margin >= chosen.margin) : now.margin > chosen.margin;
}

Verdict check_over_time(const Comparison& comparison, const DisplayUnit& unit, const Evaluation& evaluation) {
  const bool always = comparison.when == Comparison::When::always;
  const Sides sides = sides_over_time(comparison, evaluation);
  if (sides.time.empty())
    return {false, undefined, undefined, undefined, "the run has no rows in the time that is asked for"};
  Tightest chosen;
  std::size_t row = 0;
  bool holds = always;
  for (std::size_t k = 0; k < sides.time.size(); ++k) {
    const Tightest now = tightest(comparison.relations, [&](std::size_t s) { return sides.values[s][k]; });
    holds = always ? holds && now.holds : holds || now.holds;
    if (k > 0 && !replaces(now, chosen, always)) continue;
    chosen = now;
    row = k;
  }
  const Found found{comparison, unit, chosen.link};
  const double value = sides.values[found.subject()][row];
  const std::string where =
      fmt::format(" at {:.6g} s{}", sides.time[row], always ? "" : ", where it is nearest");
  return {holds, chosen.margin, value, sides.time[row],
          found.text(value, sides.values[found.bound()][row], where)};
}

/// Rows of the signal, and its values between them at the points of the tube.
Sides with_points_of(const Tube& tube, const Evaluation& evaluation, const SeriesExpression& signal) {
  const std::vector<double> value = evaluation.series(signal);
  const std::vector<double>& time = evaluation.time();
  const std::vector<double>& points = tube.any().times;
  Sides merged;
  merged.values.resize(1);
  std::size_t point = 0;
  for (std::size_t k = 0; k < time.size(); ++k) {
    for (; point < points.size() && points[point] < time[k]; ++point) {
      if (k == 0 || points[point] <= time[k - 1]) continue;
      const double part = (points[point] - time[k - 1]) / (time[k] - time[k - 1]);
      merged.time.push_back(points[point]);
      merged.values[0].push_back(value[k - 1] + part * (value[k] - value[k - 1]));
    }
    merged.time.push_back(time[k]);
    merged.values[0].push_back(value[k]);
  }
  return merged;
}

/// Where a signal comes nearest to the limits of its tube, or leaves them farthest.
struct Nearest {
  double margin = infinity, value = undefined, time = undefined;
  TubeLimits limits{0.0, 0.0};
};

Nearest nearest_to_limits(const Tube& tube, const Sides& signal) {
  const double begin = tube.any().times.front(), end = tube.any().times.back();
  TubeReader reader(tube);
  Nearest worst;
  for (std::size_t k = 0; k < signal.time.size(); ++k) {
    if (signal.time[k] < begin || signal.time[k] > end) continue;
    const double value = signal.values[0][k];
    const TubeLimits now = reader.at(signal.time[k]);
    const double margin = std::min(value - now.lower, now.upper - value);
    if (margin >= worst.margin) continue;
    worst = {margin, value, signal.time[k], now};
    if (std::isnan(margin)) break;
  }
  return worst;
}

std::string limits_text(const TubeLimits& limits, const DisplayUnit& unit) {
  if (limits.lower == -infinity) return "at most " + unit.shown(limits.upper);
  if (limits.upper == infinity) return "at least " + unit.shown(limits.lower);
  return unit.shown(limits.lower) + " to " + unit.shown(limits.upper);
}

Verdict check_tube(const Containment& containment, const DisplayUnit& unit, const Evaluation& evaluation) {
  const Tube& tube = *containment.tube;
  const double end = tube.any().times.back();
  const auto& time = evaluation.time();
  if (tube.whole && !time.empty() && time.back() < end - tube.time) {
    return {false, undefined, undefined, time.back(),
            fmt::format("the run ends at {:.6g} s, {} at {:.6g} s", time.back(), containment.file, end)};
  }
  const Nearest worst = nearest_to_limits(tube, with_points_of(tube, evaluation, containment.signal));
  if (worst.margin == infinity) {
    return {false, undefined, undefined, undefined,
            fmt::format("the run has no rows in the time of {}", containment.file)};
  }
  return {worst.margin >= 0.0, worst.margin, worst.value, worst.time,
          fmt::format("{} is {} at {:.6g} s, expected {}", containment.signal_text, unit.shown(worst.value),
                      worst.time, limits_text(worst.limits, unit))};
}

}  // namespace

std::string DisplayUnit::shown(double value) const {
  return fmt::format("{:.6g}{}{}", value / factor, name.empty() ? "" : " ", name);
}

Verdict check(const Clause& clause, const Evaluation& evaluation) {
  if (const auto* tube = std::get_if<Containment>(&clause.statement))
    return check_tube(*tube, clause.unit, evaluation);
  const auto& comparison = std::get<Comparison>(clause.statement);
  return comparison.when == Comparison::When::number ? check_numbers(comparison, clause.unit, evaluation)
                                                     : check_over_time(comparison, clause.unit, evaluation);
}

}  // namespace flyball
