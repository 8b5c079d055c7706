#include "solvers/profile.h"

#include <algorithm>
#include <chrono>

#include "solvers/instant.h"

namespace flyball {
namespace {

constexpr int parts = 50;

void most_first(std::vector<Profile::Count>& counts) {
  std::erase_if(counts, [](const Profile::Count& c) { return c.count == 0; });
  std::ranges::stable_sort(counts, std::greater<>(), &Profile::Count::count);
}

}  // namespace

Profiler::Profiler(const Plan& plan, double stop, double max_step)
    : plan_(plan), stop_(stop), max_step_(max_step), times_(plan), limiting_(plan.layout.states()) {
  for (int k = 0; k < parts; ++k) steps_.spans.push_back({stop * k / parts, stop * (k + 1) / parts});
}

Profile::Span& Profiler::span_at(double t) {
  const auto part = static_cast<std::size_t>(std::clamp(t / stop_, 0.0, 1.0) * parts);
  return steps_.spans[std::min<std::size_t>(part, parts - 1)];
}

void Profiler::step(const Step& step, const Stepper<double>& stepper, const Workspace<double>& workspace) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  const double size = step.end - step.begin;
  Profile::Span& span = span_at(step.begin);
  if (span.steps == 0) {
    times_.sample(workspace, stepper);
    span.shortest = span.longest = size;
  }
  ++span.steps;
  span.shortest = std::min(span.shortest, size);
  span.longest = std::max(span.longest, size);
  if (step.end >= step.limit) {
    ++steps_.until_instant;
  } else if (size >= max_step_ * (1.0 - 1e-9)) {  // ends are rounded
    ++steps_.at_max_step;
  } else {
    ++steps_.by_method;
    const int state = stepper.limiting_state();
    if (state >= 0) ++limiting_[static_cast<std::size_t>(state)];
  }
  own_time_ += std::chrono::duration<double>(Clock::now() - start).count();
}

Profile Profiler::profile(const ProgramCalls& calls, const EventCounts& events, const Zeros& zeros) const {
  Profile result = steps_;
  result.blocks = times_.of(calls);
  result.points = times_.points();
  result.own_time = own_time_;
  for (std::size_t k = 0; k < limiting_.size(); ++k)
    result.limiting.push_back(
        {plan_.slot_name(plan_.layout.first_state + static_cast<int>(k)), limiting_[k]});
  for (std::size_t k = 0; k < events.zeros.size(); ++k)
    result.events.push_back({zeros.name(static_cast<int>(k)), events.zeros[k]});
  for (std::size_t k = 0; k < events.alarms.size(); ++k)
    result.events.push_back({"alarm " + plan_.slot_name(plan_.alarm_records[k].slot), events.alarms[k]});
  for (std::size_t i = 0; i < plan_.rate_of.size(); ++i) {
    const int rate = plan_.rate_of[i];
    if (rate >= 0)
      result.events.push_back({"hits of " + plan_.instance(static_cast<int>(i)).name, events.hits[rate]});
  }
  most_first(result.limiting);
  most_first(result.events);
  return result;
}

}  // namespace flyball
