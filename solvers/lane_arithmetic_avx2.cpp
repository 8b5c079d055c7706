#include "solvers/lane_arithmetic_definitions.h"

namespace flyball {

template struct LaneArithmetic<Isa::avx2>;

}  // namespace flyball
