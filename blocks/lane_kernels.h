#pragma once

#include "blocks/kernels.h"
#include "blocks/lanes.h"

namespace flyball {

/// A block whose handlers look up a table says `static constexpr bool looks_up = true`: the runs of a group
/// would each look elsewhere, so it has no equations on lanes.
template <class B>
constexpr bool looks_up() {
  if constexpr (requires { B::looks_up; }) {
    return B::looks_up;
  } else {
    return false;
  }
}

/// The equations of a block on lanes. Each instruction set instantiates it in translation units of its own,
/// whose code must not run on a machine without it.
template <class B, Isa isa>
Kernels<Lanes<isa>> lane_kernels() {
  if constexpr (kernel::differentiable<B>() && !looks_up<B>()) {
    return kernel::compile<B, Lanes<isa>>();
  } else {
    return {};
  }
}

}  // namespace flyball
