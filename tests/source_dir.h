#pragma once

#include <string>

/// The root of the source tree. A function and no macro, so that only one object file depends on where it is.
std::string source_dir();
