#pragma once

namespace flyball::test {

/// Calls of operator new so far, in an executable that is linked with allocations.cpp.
long allocations();

}  // namespace flyball::test
