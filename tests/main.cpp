#define CATCH_CONFIG_MAIN
#include "tests/catch.h"
#include "tests/source_dir.h"

std::string source_dir() { return FLYBALL_SOURCE_DIR; }
