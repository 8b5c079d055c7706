#pragma once

namespace flyball {

/// The flyball command: parses the arguments and runs the subcommand. Returns the exit status.
int run_command_line(int argc, const char* const* argv);

}  // namespace flyball
