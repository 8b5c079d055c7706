#include "solvers/stepper.h"

#include <stdexcept>

#include "solvers/auto_step.h"
#include "solvers/cvode.h"
#include "solvers/discrete_step.h"
#include "solvers/dormand_prince.h"
#include "solvers/exact_step.h"
#include "solvers/fixed_step.h"

namespace flyball {
namespace {

using Make = std::unique_ptr<Stepper<double>> (*)(System<double>&, const StepperOptions&);

template <class Method>
std::unique_ptr<Stepper<double>> make(System<double>& system, const StepperOptions& options) {
  return std::make_unique<Method>(system, options);
}

struct Method {
  const char* name;
  Make make;
};

constexpr Method methods[] = {
    {"auto", make<AutoStep>},
    {"dp5", make<DormandPrince<double>>},
    {"rk4", make<RungeKutta4<double>>},
    {"heun", make<Heun<double>>},
    {"euler", make<Euler<double>>},
    {"exact", make<ExactStep>},
    {"discrete", make<DiscreteStep>},
    {"adams", make_adams},
    {"bdf", make_bdf},
};

}  // namespace

std::unique_ptr<Stepper<double>> make_stepper(const std::string& method, System<double>& system,
                                              const StepperOptions& options) {
  for (const Method& candidate : methods) {
    if (candidate.name == method) return candidate.make(system, options);
  }
  throw std::invalid_argument("there is no method \"" + method + "\"");
}

const std::vector<std::string>& stepper_methods() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Method& method : methods) all.emplace_back(method.name);
    return all;
  }();
  return names;
}

}  // namespace flyball
