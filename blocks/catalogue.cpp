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
  BLOCK(continuous, TransportDelay)       \
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
  BLOCK(nonlinear, LookupTable1D)         \
  BLOCK(nonlinear, LookupTable2D)         \
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
  BLOCK(robot, DifferentialDriveForward)  \
  BLOCK(robot, DifferentialDriveInverse)  \
  BLOCK(robot, WheelMotors)               \
  BLOCK(robot, WheelSlip)                 \
  BLOCK(robot, PoseIntegrator)            \
  BLOCK(robot, Unicycle)                  \
  BLOCK(robot, MecanumDrive)              \
  BLOCK(robot, MecanumInverse)            \
  BLOCK(sensors, Encoder)                 \
  BLOCK(sensors, EncoderOdometry)         \
  BLOCK(sensors, Gyro)                    \
  BLOCK(sensors, LandmarkSensor)          \
  BLOCK(sensors, LandmarkCorrection)      \
  BLOCK(navigation, LineNavigation)       \
  BLOCK(navigation, ArcNavigation)        \
  BLOCK(navigation, PathSequencer)        \
  BLOCK(navigation, DeviationPID)         \
  BLOCK(navigation, WheelSpeedAllocation) \
  BLOCK(navigation, PurePursuit)          \
  BLOCK(navigation, Stanley)              \
  BLOCK(navigation, Waypoints)            \
  BLOCK(navigation, RoadmapPlanner)       \
  BLOCK(navigation, WaypointSelector)     \
  BLOCK(navigation, PoseError)            \
  BLOCK(navigation, KanayamaTracker)      \
  BLOCK(navigation, VelocityLimiter)      \
  BLOCK(navigation, MotorLimiter)         \
  BLOCK(navigation, StepGenerator)        \
  BLOCK(navigation, StepperWheelSpeed)    \
  BLOCK(navigation, CrossTrackError)      \
  BLOCK(navigation, LinearVelocityError)

#include <stdexcept>
#include <unordered_map>
#include <utility>

#include "blocks/registry.h"

namespace flyball {

#define FLYBALL_DECLARE(family, Class) \
  struct Class;                        \
  template <>                          \
  BlockType block_type<Class>();
FLYBALL_CATALOGUE(FLYBALL_DECLARE)
#undef FLYBALL_DECLARE

namespace {

/// What the program knows. A type stays where it is when others are added: blocks point to theirs.
struct Known {
  std::deque<BlockType> types;
  std::unordered_map<std::string_view, const BlockType*> by_name;
  std::vector<std::string> names;

  /// Constructing the default checks its declarations.
  void add(BlockType added) {
    added.create();
    const BlockType& type = types.emplace_back(std::move(added));
    by_name.emplace(type.name, &type);
    names.push_back(type.name);
    for (const std::string& alias : type.aliases) by_name.emplace(alias, &type);
    names.insert(names.end(), type.aliases.begin(), type.aliases.end());
  }
};

Known& known() {
  static Known known = [] {
    Known all;
#define FLYBALL_ADD(family, Class) all.add(block_type<Class>());
    FLYBALL_CATALOGUE(FLYBALL_ADD)
#undef FLYBALL_ADD
    return all;
  }();
  return known;
}

}  // namespace

const std::deque<BlockType>& catalogue() { return known().types; }

const std::vector<std::string>& block_type_names() { return known().names; }

const BlockType* find_block_type(std::string_view name) {
  const auto found = known().by_name.find(name);
  return found == known().by_name.end() ? nullptr : found->second;
}

void add_block_type(BlockType type) {
  if (find_block_type(type.name) != nullptr)
    throw std::logic_error("block " + type.name + ": there is one of this name");
  known().add(std::move(type));
}

}  // namespace flyball
