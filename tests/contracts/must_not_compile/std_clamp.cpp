// std::clamp silently takes one branch of a derivative.
#include <algorithm>

#include "blocks/registry.h"

namespace flyball {

struct Probe : Block {
  static constexpr auto summary = "Clamps with the standard library.";
  Param limit = param("limit", 1.0, "any", any, "limit");
  Input u = input("u", "any", "signal");
  State x = state("x", 0.0, "any", "state");
  Output y = output("y", "any", "output");

  void outputs(auto& v) const { v[y] = std::clamp(v[u], -v[limit], v[limit]); }
  void rates(auto& v) const { v.rate(x) = v[u] - v[y]; }
};

template <>
BlockType block_type<Probe>() {
  return describe<Probe>("Probe", "test");
}

}  // namespace flyball
