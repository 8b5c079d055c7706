// Every block runs on the dimension scalar.
#include "tests/catch.h"
#include "tests/contracts/cases.h"

namespace flyball::test {
namespace {

bool same_methods(const Kernels<double>& a, const Kernels<Dimensional>& b) {
  const auto both = [](auto p, auto q) { return (p != nullptr) == (q != nullptr); };
  return both(a.outputs, b.outputs) && both(a.rates, b.rates) && both(a.relations, b.relations) &&
         both(a.crossings, b.crossings) && both(a.schedule, b.schedule) && both(a.on_sample, b.on_sample) &&
         both(a.on_time, b.on_time) && both(a.on_crossing, b.on_crossing);
}

bool names_a_slot(int unknown, const Specification& spec) {
  const int literals = static_cast<int>(spec.literals.size());
  return unknown >= -literals && unknown < BlockObject::slot_unknown(static_cast<int>(spec.slots.size()));
}

}  // namespace

TEST_CASE("the equations of every block run on the dimension scalar") {
  for (const Case& c : cases()) {
    const BlockObject object = c.object();
    INFO(c.type << " (" << c.label << ")");
    if (!object.type->differentiable) continue;
    CHECK(same_methods(object.type->kernels.on_double, object.type->kernels.on_dimensional));
    for (const DimensionEquation& equation : object.dimensions) {
      bool has_slot = false;
      for (const auto& [unknown, coefficient] : equation.form.terms()) {
        CHECK(names_a_slot(unknown, *object.specification));
        has_slot = has_slot || unknown < 0 || unknown >= base_units;
      }
      // Else an equation contradicts itself, whatever is connected.
      CHECK(has_slot);
    }
  }
}

}  // namespace flyball::test
