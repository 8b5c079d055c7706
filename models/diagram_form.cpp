#include "models/diagram_form.h"

namespace flyball {

BlockForm::BlockForm(BlockObject block) : object(std::make_shared<const BlockObject>(std::move(block))) {
  const auto& slots = specification().slots;
  input_rank.assign(slots.size(), -1);
  for (int s = 0; s < static_cast<int>(slots.size()); ++s) {
    if (slots[s].kind == SlotKind::param) params.push_back(s);
    if (slots[s].kind != SlotKind::input && slots[s].kind != SlotKind::object_input) continue;
    input_rank[s] = static_cast<int>(inputs.size());
    inputs.push_back(s);
  }
}

}  // namespace flyball
