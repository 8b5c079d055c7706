#pragma once

// Catch2 2.13 and 3 differ in the name of their header only, as far as these tests are concerned.
#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>
#else
#include <catch2/catch.hpp>
#endif
