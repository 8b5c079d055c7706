#pragma once
#include "blocks/block.h"

namespace flyball {

/// What the continuous and the sampled PID controller have in common: gains, setpoint weights, limits,
/// errors.
struct PIDTerms : Block {
  using Block::Block;

  bool two_inputs = flag("setpoint_weights", false, "inputs setpoint and measurement instead of the error e");
  int anti_windup =
      option("anti_windup", "none", {"none", "clamping", "back_calculation"},
             "clamping: I stays within the limits of u; back_calculation: I follows the limited u");
  bool clamps = anti_windup == 1, tracks = anti_windup == 2;
  bool limits_output = given("lower") || given("upper") || clamps || tracks;
  Param Kp = param("Kp", 1.0, "any", any, "proportional gain");
  Param Ki = param("Ki", 0.0, "any", any, "integral gain");
  Param Kd = param("Kd", 0.0, "any", any, "derivative gain");
  Param b = param_if(two_inputs, "b", 1.0, "1", any, "weight of the setpoint in P");
  Param c = param_if(two_inputs, "c", 1.0, "1", any, "weight of the setpoint in D");
  Param lower = param_if(limits_output, "lower", -1.0, "any", any, "lower limit of u");
  Param upper = param_if(limits_output, "upper", 1.0, "any", any, "upper limit of u");
  Param Tt = param_if(tracks, "Tt", 1.0, "s", positive, "time in which I follows the limited u");
  Input e = input_if(!two_inputs, "e", "any", "control error");
  Input setpoint = input_if(two_inputs, "setpoint", "any", "wanted value");
  Input measurement = input_if(two_inputs, "measurement", "any", "measured value");
  Output u = output("u", "any", "control effort");

  auto error(auto& v) const { return two_inputs ? v[setpoint] - v[measurement] : v[e]; }
  auto error(auto& v, Param weight) const {
    return two_inputs ? v[weight] * v[setpoint] - v[measurement] : v[e];
  }
};

}  // namespace flyball
