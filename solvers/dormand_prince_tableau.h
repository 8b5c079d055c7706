#pragma once

/// Source: Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, 2nd ed., table II.5.2. The
/// last row of a is the fifth-order solution.
namespace flyball::dormand_prince {

inline constexpr double c2 = 1.0 / 5.0, c3 = 3.0 / 10.0, c4 = 4.0 / 5.0, c5 = 8.0 / 9.0;
inline constexpr double a2[] = {1.0 / 5.0};
inline constexpr double a3[] = {3.0 / 40.0, 9.0 / 40.0};
inline constexpr double a4[] = {44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0};
inline constexpr double a5[] = {19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0};
inline constexpr double a6[] = {9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0,
                                -5103.0 / 18656.0};
inline constexpr double a7[] = {35.0 / 384.0,     0.0,        500.0 / 1113.0, 125.0 / 192.0,
                                -2187.0 / 6784.0, 11.0 / 84.0};
// Fifth- minus fourth-order weights.
inline constexpr double e[] = {71.0 / 57600.0,      0.0,          -71.0 / 16695.0, 71.0 / 1920.0,
                               -17253.0 / 339200.0, 22.0 / 525.0, -1.0 / 40.0};
// Shampine's choice of the quartic term of the extension, as in dopri5.f.
inline constexpr double d[] = {-12715105075.0 / 11282082432.0,  0.0,
                               87487479700.0 / 32700410799.0,   -10690763975.0 / 1880347072.0,
                               701980252875.0 / 199316789632.0, -1453857185.0 / 822651844.0,
                               69997945.0 / 29380423.0};

// The controller of dopri5.f.
inline constexpr double safety = 0.9, beta = 0.04, exponent = 0.2 - 0.75 * beta;
inline constexpr double least_factor = 0.2, greatest_factor = 10.0, least_error = 1e-4;

}  // namespace flyball::dormand_prince
