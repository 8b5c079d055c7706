#pragma once

#include <string_view>

namespace flyball {

/// Keeps the numbers 0, 1 and 2 for the standard streams: a file that is opened while one of them is closed
/// would take its number, and what is printed would end up in the file.
void reserve_standard_streams();

/// Writes to standard output, all of it. Throws OutputError.
void print(std::string_view text);
/// Writes to standard error; nobody could be told of a failure.
void complain(std::string_view text);

bool output_is_terminal();
bool error_is_terminal();

}  // namespace flyball
