#pragma once
#include "blocks/block.h"

namespace flyball {

/// What the continuous and the sampled PID controller have in common: form, gains, setpoint weights, limits,
/// errors, and what comes from outside.
struct PIDTerms : Block {
  using Block::Block;

  int form = option("form", "parallel", {"parallel", "ideal", "series"},
                    "Kp + Ki/s + Kd s; Kp (1 + Ki/s + Kd s); or Kp (1 + Ki/s)(1 + Kd s)");
  bool two_inputs = flag("setpoint_weights", false, "inputs setpoint and measurement instead of the error e");
  int anti_windup =
      option("anti_windup", "none", {"none", "clamping", "back_calculation", "tracking"},
             "clamping: I stays within the limits of u; back_calculation: I follows the limited u; tracking: "
             "I follows the input u_actual");
  bool clamps = anti_windup == 1, follows_limits = anti_windup == 2, follows_input = anti_windup == 3;
  bool tracks = follows_limits || follows_input;
  bool feeds_forward = flag("feed_forward", false, "an input u_ff, which is added to u");
  bool has_manual =
      flag("manual_mode", false,
           "inputs automatic and u_manual: u is u_manual while automatic is below 1/2, and goes on "
           "from there without a jump");
  bool limits_output = given("lower") || given("upper") || clamps || follows_limits;
  Param Kp = param("Kp", 1.0, "any", any, "proportional gain");
  Param Ki = param("Ki", 0.0, "any", any, "integral gain; 1/Ti in the ideal and series forms");
  Param Kd = param("Kd", 0.0, "any", any, "derivative gain; Td in the ideal and series forms");
  Param b = param_if(two_inputs, "b", 1.0, "1", any, "weight of the setpoint in P");
  Param c = param_if(two_inputs, "c", 1.0, "1", any, "weight of the setpoint in D");
  Param lower = param_if(limits_output, "lower", -1.0, "any", any, "lower limit of u");
  Param upper = param_if(limits_output, "upper", 1.0, "any", any, "upper limit of u");
  Param Tt = param_if(tracks, "Tt", 1.0, "s", positive, "time in which I follows");
  Input e = input_if(!two_inputs, "e", "any", "control error");
  Input setpoint = input_if(two_inputs, "setpoint", "any", "wanted value");
  Input measurement = input_if(two_inputs, "measurement", "any", "measured value");
  Input u_actual = input_if(follows_input, "u_actual", "any", "what the actuator makes of u");
  Input u_ff = input_if(feeds_forward, "u_ff", "any", "feed-forward");
  Input automatic = input_if(has_manual, "automatic", "1", "1: the controller decides; 0: u_manual does");
  Input u_manual = input_if(has_manual, "u_manual", "any", "control effort while automatic is 0");
  Output u = output("u", "any", "control effort");

  auto error(auto& v) const { return two_inputs ? v[setpoint] - v[measurement] : v[e]; }
  auto error(auto& v, Param weight) const {
    return two_inputs ? v[weight] * v[setpoint] - v[measurement] : v[e];
  }

  // The gains of the parallel form that is equal. In the series form, where the derivative has a pole N,
  //   (1 + Ki/s)(1 + Kd N s/(s + N)) = 1 + Ki Kd + Ki/s + Kd (1 - Ki/N) N s/(s + N).
  auto proportional(auto& v) const { return form == 2 ? v[Kp] * (1.0 + v[Ki] * v[Kd]) : v[Kp]; }
  auto integral(auto& v) const { return form == 0 ? v[Ki] : v[Kp] * v[Ki]; }
  auto derivative(auto& v, Param N) const {
    const auto ideal = form == 0 ? v[Kd] : v[Kp] * v[Kd];
    return form == 2 && N.declared() ? ideal * (1.0 - v[Ki] / v[N]) : ideal;
  }
  /// What is added to I.
  auto with_feed_forward(auto& v, const auto& sum) const { return feeds_forward ? sum + v[u_ff] : sum; }
  /// Where back calculation wants the sum to be.
  auto target(auto& v) const { return follows_input ? v[u_actual] : v[u]; }
};

}  // namespace flyball
