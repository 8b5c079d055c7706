#include "solvers/handlers.h"

#include <cmath>
#include <utility>

namespace flyball {
namespace {

bool differs(double a, double b) { return a != b; }
bool differs(const Jet& a, const Jet& b) { return a.a != b.a || a.v != b.v; }

}  // namespace

template <class T>
Handlers<T>::Handlers(const Plan& plan, Workspace<T>& workspace)
    : plan_(plan), workspace_(workspace), is_staged_(plan.placed.size(), 0) {
  staged_first_.push_back(0);
  for (int i = 0; i < static_cast<int>(plan.placed.size()); ++i) {
    const auto& slots = plan.instance(i).object->specification->slots;
    for (int s = 0; s < static_cast<int>(slots.size()); ++s) {
      const bool staged = slots[s].kind == SlotKind::state || slots[s].kind == SlotKind::held;
      if (staged) staged_.push_back(plan.index_of(i)[s]);
    }
    staged_first_.push_back(static_cast<int>(staged_.size()));
  }
  touched_.reserve(plan.placed.size());
}

template <class T>
void Handlers<T>::run(const std::vector<HandlerCall>& calls) {
  for (const HandlerCall& call : calls) {
    const int i = call.instance;
    if (is_staged_[i] != 0) {
      run_again(call);
      continue;
    }
    is_staged_[i] = 1;
    touched_.push_back(i);
    for (int k = staged_first_[i]; k < staged_first_[i + 1]; ++k) {
      next(staged_[k]) = workspace_.values[staged_[k]];
    }
    run_one(call);
  }
}

/// A second handler of one block sees what its first one staged, while all others still see this sweep.
template <class T>
void Handlers<T>::run_again(const HandlerCall& call) {
  const int first = staged_first_[call.instance], last = staged_first_[call.instance + 1];
  saved_.clear();
  for (int k = first; k < last; ++k) {
    saved_.push_back(workspace_.values[staged_[k]]);
    workspace_.values[staged_[k]] = next(staged_[k]);
  }
  run_one(call);
  for (int k = first; k < last; ++k) workspace_.values[staged_[k]] = saved_[k - first];
}

template <class T>
void Handlers<T>::run_one(const HandlerCall& call) {
  const BlockObject& object = *plan_.instance(call.instance).object;
  const Kernels<T>& kernels = object.type->kernels.template on<T>();
  const Frame<T> f = frame(plan_, workspace_);
  const int* index = plan_.index_of(call.instance);
  switch (call.method) {
    case HandlerCall::Method::on_sample:
      return kernels.on_sample(object.self.get(), f, index);
    case HandlerCall::Method::on_time:
      return kernels.on_time(object.self.get(), f, index);
    case HandlerCall::Method::on_crossing:
      return kernels.on_crossing(object.self.get(), f, index, call.local);
  }
}

template <class T>
int Handlers<T>::bad_slot() const {
  for (const int i : touched_) {
    for (int k = staged_first_[i]; k < staged_first_[i + 1]; ++k) {
      if (!std::isfinite(value_of(next(staged_[k])))) return staged_[k];
    }
  }
  return -1;
}

template <class T>
bool Handlers<T>::commit() {
  bool visible = false;
  for (const int i : touched_) {
    is_staged_[i] = 0;
    for (int k = staged_first_[i]; k < staged_first_[i + 1]; ++k) {
      T& value = workspace_.values[staged_[k]];
      const bool seen = plan_.rate_of[i] < 0 || staged_[k] < plan_.layout.first_held;
      visible = visible || (seen && differs(next(staged_[k]), value));
      value = next(staged_[k]);
    }
  }
  touched_.clear();
  for (std::size_t k = 0; k < workspace_.next_objects.size(); ++k) {
    if (workspace_.next_objects[k] != nullptr) workspace_.objects[k] = std::move(workspace_.next_objects[k]);
  }
  return visible;
}

template class Handlers<double>;
template class Handlers<Jet>;

}  // namespace flyball
