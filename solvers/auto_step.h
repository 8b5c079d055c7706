#pragma once

#include <memory>

#include "solvers/dormand_prince.h"
#include "solvers/stepper.h"

namespace flyball {

/// Dormand and Prince's steps until stability limits them, not accuracy; BDF from then on.
///
/// The test is that of dopri5.f with a lower limit: h |lambda| as the last two stages show it exceeds 1.5 in
/// 15 steps, without 6 in a row that do not. Only steps since rates changed at an instant count: BDF begins
/// at order 1 behind each change, and pays where there are many steps between two of them. Which method runs
/// is part of StepMemory.
class AutoStep final : public Stepper<double> {
 public:
  AutoStep(System<double>& system, const StepperOptions& options);

  void restart(double t, const double* x, StepMemory& memory, bool changed) override;
  double step(double limit, StepMemory& memory) override;
  const double* state() const override { return bdf_ ? bdf_->state() : explicit_.state(); }
  void interpolate(double t, double* x) override {
    bdf_ ? bdf_->interpolate(t, x) : explicit_.interpolate(t, x);
  }
  bool ends_with_rates() const override { return bdf_ == nullptr; }
  std::optional<Extension<double>> extension() override {
    return bdf_ ? std::nullopt : explicit_.extension();
  }
  int limiting_state() const override { return bdf_ ? bdf_->limiting_state() : explicit_.limiting_state(); }
  StepperStatistics statistics() const override;

 private:
  void test(StepMemory& memory) const;

  System<double>& system_;
  StepperOptions options_;
  DormandPrince<double> explicit_;
  std::unique_ptr<Stepper<double>> bdf_;  // made when it is first needed
  double end_ = 0.0;                      // of the last explicit step [s]
  bool begun_ = false;
};

}  // namespace flyball
