#pragma once

#include "blocks/registry.h"
#include "blocks/shim.h"

namespace flyball {

template <class B>
Kernels<Jet> jet_kernels() {
  if constexpr (kernel::differentiable<B>()) {
    return kernel::compile<B, Jet>();
  } else {
    return kernel::compile_shim<B>();
  }
}

}  // namespace flyball
