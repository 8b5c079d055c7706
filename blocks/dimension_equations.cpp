#include "blocks/dimension_equations.h"

namespace flyball {
namespace {

using Kind = DimensionEquation::Kind;

constexpr int seconds = 2;  // among the base units

class DimensionRun {
 public:
  DimensionRun(const BlockType& type, const BlockObject& object)
      : kernels_(type.kernels.on_dimensional),
        self_(object.self.get()),
        spec_(*object.specification),
        size_(static_cast<int>(spec_.slots.size())),
        values_(size_),
        rates_(size_),
        objects_(size_),
        memories_(size_) {
    for (int s = 0; s < size_; ++s) {
      index_.push_back(s);
      own_.push_back(s == 0 ? Dimensional(seconds, recorder_)
                            : Dimensional(BlockObject::slot_unknown(s), recorder_));
    }
    frame_.values = values_.data();
    for (int s = 0; s < size_; ++s) {
      if (spec_.slots[s].make_object) objects_[s] = spec_.slots[s].make_object();
      if (spec_.slots[s].make_memory != nullptr) memories_[s] = spec_.slots[s].make_memory();
    }
    frame_.rates = rates_.data();
    frame_.objects = frame_.next_objects = objects_.data();
    frame_.memories = memories_.data();
  }

  std::vector<DimensionEquation> run() {
    values_ = own_;
    sweep(Phase::outputs);
    for (const Phase phase : {Phase::relations, Phase::crossings, Phase::schedule, Phase::rates}) {
      values_ = own_;
      sweep(phase);
    }
    values_ = own_;
    if (kernels_.on_sample != nullptr) handle([&] { kernels_.on_sample(self_, frame_, index_.data()); });
    if (kernels_.on_time != nullptr) handle([&] { kernels_.on_time(self_, frame_, index_.data()); });
    for (int c = 0; c < size_; ++c) {
      if (spec_.slots[c].kind != SlotKind::crossing) continue;
      handle([&] { kernels_.on_crossing(self_, frame_, index_.data(), c); });
    }
    for (int s = 0; s < size_; ++s) {
      const int initial = spec_.slots[s].initial_param;
      if (initial >= 0) demand(Kind::equal, own_[s], own_[initial]);
    }
    return recorder_.take();
  }

 private:
  void sweep(Phase phase) {
    const auto kernel = kernels_.sweep(phase);
    if (kernel == nullptr) return;
    kernel(self_, frame_, index_.data(), size_, 1);
    for (int s = 0; s < size_; ++s) {
      if (spec_.slots[s].kind != result_of(phase)) continue;
      if (phase == Phase::outputs) demand(Kind::equal, own_[s], values_[s]);
      if (phase == Phase::schedule) demand(Kind::equal, own_[0], values_[s]);
      if (phase == Phase::rates) demand(Kind::rate, own_[s] / own_[0], rates_[s]);
    }
  }

  void handle(auto call) {
    next_ = own_;
    frame_.next = next_.data();
    call();
    for (int s = 0; s < size_; ++s) demand(Kind::equal, own_[s], next_[s]);
  }

  void demand(Kind kind, const Dimensional& slot, const Dimensional& value) {
    if (value.form() == nullptr) return;
    LinearForm difference = *slot.form();
    if (difference.add(*value.form(), Rational(-1))) recorder_.demand(kind, std::move(difference));
  }

  const Kernels<Dimensional>& kernels_;
  const void* self_;
  const Specification& spec_;
  int size_;
  DimensionRecorder recorder_;
  std::vector<Dimensional> own_, values_, rates_, next_;
  std::vector<std::shared_ptr<const void>> objects_;
  std::vector<std::any> memories_;
  std::vector<int> index_;
  Frame<Dimensional> frame_;
};

}  // namespace

std::vector<DimensionEquation> dimension_equations(const BlockType& type, const BlockObject& object) {
  return DimensionRun(type, object).run();
}

}  // namespace flyball
