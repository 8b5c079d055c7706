#pragma once

#include "blocks/kernels.h"
#include "blocks/lanes.h"

namespace flyball {

namespace kernel {

/// Whether runs in lockstep can share the calls of a block. One that looks up a table by a held value, which
/// each run has for itself, says `static constexpr bool lockstep = false`.
template <class B>
constexpr bool lockstep() {
  if constexpr (requires { B::lockstep; }) {
    return B::lockstep;
  } else {
    return differentiable<B>();
  }
}

}  // namespace kernel

/// The equations of a block on lanes; none where it cannot go in lockstep. Each instruction set instantiates
/// it in translation units of its own, whose code must not run on a machine without it.
template <class B, Isa isa>
Kernels<Lanes<isa>> lane_kernels() {
  if constexpr (kernel::lockstep<B>()) {
    return kernel::compile<B, Lanes<isa>>();
  } else {
    return {};
  }
}

}  // namespace flyball
