// An output that reads an output hides what it depends on.
#include "blocks/registry.h"

namespace flyball {

struct Probe : Block {
  static constexpr auto summary = "Reads an output in outputs.";
  Param limit = param("limit", 1.0, "any", any, "limit");
  Input u = input("u", "any", "signal");
  State x = state("x", 0.0, "any", "state");
  Output y = output("y", "any", "output");

  void outputs(auto& v) const {
    v[y] = v[u];
    v[y] = 2.0 * v[y];
  }
  void rates(auto& v) const { v.rate(x) = v[u] - v[y]; }
};

template <>
BlockType block_type<Probe>() {
  return describe<Probe>("Probe", "test");
}

}  // namespace flyball
