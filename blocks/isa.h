#pragma once

namespace flyball {

/// The instruction sets that lanes are compiled for: what every machine of its kind has, and AVX2.
enum class Isa { baseline, avx2 };

#if defined(__x86_64__)
inline constexpr bool compiled_for_avx2 = true;
#else
inline constexpr bool compiled_for_avx2 = false;
#endif

/// Whether this program has code for the instruction set, and this machine runs it.
bool supports(Isa isa);

/// The widest that this machine supports.
Isa widest_isa();

/// Runs that go in lockstep. The same for every instruction set, so that none changes the bytes of a result.
inline constexpr int lane_count = 4;

template <Isa isa>
class Lanes;

}  // namespace flyball
