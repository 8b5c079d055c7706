#include "solvers/lane_arithmetic_definitions.h"

namespace flyball {

template struct LaneArithmetic<Isa::baseline>;

}  // namespace flyball
