// The blocks, one line each, in the order of the reference: the family, which is the folder, and the class.
// The file is named after the class (UnitDelay: unit_delay.h); the build reads these lines to compile each
// family.
#define FLYBALL_CATALOGUE(BLOCK)          \
  BLOCK(sources, Constant)                \
  BLOCK(sources, Step)                    \
  BLOCK(sources, Ramp)                    \
  BLOCK(sources, SineWave)                \
  BLOCK(sources, Chirp)                   \
  BLOCK(sources, PulseGenerator)          \
  BLOCK(sources, RepeatingSequence)       \
  BLOCK(sources, FromFile)                \
  BLOCK(sources, RandomNumber)            \
  BLOCK(sources, UniformRandomNumber)     \
  BLOCK(sources, BandLimitedWhiteNoise)   \
  BLOCK(sources, Clock)                   \
  BLOCK(math, Gain)                       \
  BLOCK(math, Sum)                        \
  BLOCK(math, Product)                    \
  BLOCK(math, Divide)                     \
  BLOCK(math, Abs)                        \
  BLOCK(math, Sign)                       \
  BLOCK(math, MinMax)                     \
  BLOCK(math, TrigonometricFunction)      \
  BLOCK(math, LogicalOperator)            \
  BLOCK(math, RelationalOperator)         \
  BLOCK(math, MathFunction)               \
  BLOCK(math, Expression)                 \
  BLOCK(continuous, Integrator)           \
  BLOCK(continuous, Derivative)           \
  BLOCK(continuous, TransferFcn)          \
  BLOCK(continuous, StateSpace)           \
  BLOCK(continuous, ZeroPole)             \
  BLOCK(discrete, UnitDelay)              \
  BLOCK(discrete, Delay)                  \
  BLOCK(discrete, ZeroOrderHold)          \
  BLOCK(discrete, DiscreteRateLimiter)    \
  BLOCK(discrete, DiscreteBacklash)       \
  BLOCK(discrete, DiscreteTimeIntegrator) \
  BLOCK(discrete, DiscreteTransferFcn)    \
  BLOCK(discrete, DiscreteStateSpace)     \
  BLOCK(discrete, Counter)                \
  BLOCK(discrete, CounterLimited)         \
  BLOCK(nonlinear, Saturation)            \
  BLOCK(nonlinear, DeadZone)              \
  BLOCK(nonlinear, Backlash)              \
  BLOCK(nonlinear, Quantizer)             \
  BLOCK(nonlinear, RateLimiter)           \
  BLOCK(nonlinear, Relay)                 \
  BLOCK(nonlinear, HitCrossing)           \
  BLOCK(routing, Switch)                  \
  BLOCK(routing, Mux)                     \
  BLOCK(routing, Demux)                   \
  BLOCK(routing, Selector)                \
  BLOCK(sinks, Terminator)                \
  BLOCK(sinks, Assertion)                 \
  BLOCK(sinks, StopSimulation)            \
  BLOCK(control, PID)                     \
  BLOCK(control, DiscretePID)             \
  BLOCK(hybrid, BouncingBall)             \
  BLOCK(robot, DifferentialDrive)         \
  BLOCK(robot, Unicycle)                  \
  BLOCK(robot, MecanumDrive)              \
  BLOCK(robot, MecanumInverse)

#include "blocks/registry.h"

namespace flyball {

#define FLYBALL_DECLARE(family, Class) \
  struct Class;                        \
  template <>                          \
  BlockType block_type<Class>();
FLYBALL_CATALOGUE(FLYBALL_DECLARE)
#undef FLYBALL_DECLARE

const std::vector<BlockType>& catalogue() {
  // Types are complete before anyone sees them; constructing each default checks its declarations.
  static const std::vector<BlockType> types = [] {
    std::vector<BlockType> all;
#define FLYBALL_ADD(family, Class) all.push_back(block_type<Class>());
    FLYBALL_CATALOGUE(FLYBALL_ADD)
#undef FLYBALL_ADD
    for (const BlockType& type : all) type.create();
    return all;
  }();
  return types;
}

}  // namespace flyball
