#pragma once
#include "blocks/block.h"

namespace flyball {

struct StepGenerator : Block {
  static constexpr auto summary =
      "Steps of two motors from the wheel speeds that are wanted: at most one a hit.";
  SampleTime ts = sample_time();
  bool whole = flag("whole_steps", true, "false: fractions of a step, too, as if the motors turned evenly");
  Param step_angle = param("step_angle", 0.0065, "rad", positive, "turn of a wheel at a step");
  Input right = input("right", "rad/s", "wanted speed of the right wheel");
  Input left = input("left", "rad/s", "wanted speed of the left wheel");
  Output right_step = output("right_step", "1", "1 forward, -1 backward, 0 none");
  Output left_step = output("left_step", "1", "1 forward, -1 backward, 0 none");
  Output right_count = output("right_count", "1", "steps forward less steps backward, this one included");
  Output left_count = output("left_count", "1", "steps forward less steps backward, this one included");
  Output right_lost = output("right_lost", "rad", "turn that came too fast for the steps, and was dropped");
  Output left_lost = output("left_lost", "rad", "turn that came too fast for the steps, and was dropped");
  Held right_rest = held("right_rest", 0.0, "rad", "turn of the right wheel that was not stepped yet");
  Held left_rest = held("left_rest", 0.0, "rad", "turn of the left wheel that was not stepped yet");
  Held right_steps = held("right_steps", 0.0, "1", "steps before");
  Held left_steps = held("left_steps", 0.0, "1", "steps before");
  Held right_dropped = held("right_dropped", 0.0, "rad", "lost before");
  Held left_dropped = held("left_dropped", 0.0, "rad", "lost before");

  void outputs(auto& v) const {
    const auto r = wheel(v, right, right_rest), l = wheel(v, left, left_rest);
    v[right_step] = r.step;
    v[left_step] = l.step;
    v[right_count] = v[right_steps] + r.step;
    v[left_count] = v[left_steps] + l.step;
    v[right_lost] = v[right_dropped] + r.lost;
    v[left_lost] = v[left_dropped] + l.lost;
  }
  void on_sample(auto& v) const {
    v.next(right_rest) = rest_after(v, right, right_rest, right_step) - (v[right_lost] - v[right_dropped]);
    v.next(left_rest) = rest_after(v, left, left_rest, left_step) - (v[left_lost] - v[left_dropped]);
    v.next(right_steps) = v[right_count];
    v.next(left_steps) = v[left_count];
    v.next(right_dropped) = v[right_lost];
    v.next(left_dropped) = v[left_lost];
  }

 private:
  template <class T>
  struct Wheel {
    T step, lost;
  };

  // Add, compare, subtract: what is left over depends on this order.
  auto wheel(auto& v, Input wanted, Held rest) const -> Wheel<std::decay_t<decltype(v[wanted])>> {
    const auto turn = v[rest] + v[wanted] * v[ts];
    const auto trigger = [](double angle, double size) {
      return angle >= size ? 1.0 : angle <= -size ? -1.0 : 0.0;
    };
    const auto beyond = [](double angle, double size) {
      return std::fabs(angle) < size ? 0.0 : std::trunc(angle / size);
    };
    const auto step = whole ? stepwise(trigger, turn, v[step_angle]) : turn / v[step_angle];
    const auto after = turn - v[step_angle] * step;
    return {step, v[step_angle] * stepwise(beyond, after, v[step_angle])};
  }
  auto rest_after(auto& v, Input wanted, Held rest, Output step) const {
    return v[rest] + v[wanted] * v[ts] - v[step_angle] * v[step];
  }
};

}  // namespace flyball
