#pragma once

#include "blocks/kernels.h"
#include "blocks/lanes.h"

namespace flyball {

/// The equations of a block on lanes. Each instruction set instantiates it in translation units of its own,
/// whose code must not run on a machine without it.
template <class B, Isa isa>
Kernels<Lanes<isa>> lane_kernels() {
  // A block that remembers has one memory, for one run.
  if constexpr (kernel::differentiable<B>() && !kernel::OnStep<B, View<double, Phase::step>>) {
    return kernel::compile<B, Lanes<isa>>();
  } else {
    return {};
  }
}

}  // namespace flyball
