// A bare branch on a signal is a discontinuity that nobody can locate.
#include "blocks/registry.h"

namespace flyball {

struct Probe : Block {
  static constexpr auto summary = "Branches on a signal.";
  Param limit = param("limit", 1.0, "any", any, "limit");
  Input u = input("u", "any", "signal");
  State x = state("x", 0.0, "any", "state");
  Output y = output("y", "any", "output");

  void outputs(auto& v) const {
    if (v[u] > v[limit]) {
      v[y] = v[limit];
    } else {
      v[y] = v[u];
    }
  }
  void rates(auto& v) const { v.rate(x) = v[u] - v[y]; }
};

template <>
BlockType block_type<Probe>() {
  return describe<Probe>("Probe", "test");
}

}  // namespace flyball
