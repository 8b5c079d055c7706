#include "blocks/isa.h"

namespace flyball {

bool supports(Isa isa) {
  if (isa == Isa::baseline) return true;
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx2") != 0;
#else
  return false;
#endif
}

Isa widest_isa() { return supports(Isa::avx2) ? Isa::avx2 : Isa::baseline; }

}  // namespace flyball
