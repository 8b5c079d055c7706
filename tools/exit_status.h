#pragma once

namespace flyball {

/// What the command tells its caller. 128 + the signal's number after an interrupt.
enum ExitStatus : int {
  exit_done = 0,
  exit_requirement_failed = 1,
  exit_usage = 2,
  exit_model_error = 3,
  exit_numerical_failure = 4,
  exit_input_output = 5
};

}  // namespace flyball
