#pragma once

namespace flyball {

/// The count of steps that stability limits, of dopri5.f: stiff after 15 of them, without 6 in a row that are
/// not.
struct StiffnessCount {
  /// h |lambda| from which on a step counts. That of dopri5.f is 3.25, just below the end of stability; but
  /// where something that moves drives a stiff part, order reduction holds it at half of that, still dozens
  /// of times below what BDF can do, while problems that are not stiff stay below 1 but for a few steps
  /// (docs/decisions/0016).
  static constexpr double limit = 1.5;
  static constexpr int stiff_in_all = 15, calm_in_a_row = 6;
  /// While nothing is suspected, a test now and then will do: it costs a twentieth of a step of a few states.
  static constexpr int steps_between_tests = 10;

  int untested = 0;
  int stiff = 0, calm = 0;  // since the count began anew

  /// Whether the step that was just taken is to be tested.
  bool due() {
    if (stiff == 0 && ++untested < steps_between_tests) return false;
    untested = 0;
    return true;
  }
  /// Takes the answer of a test; true where the run is stiff.
  bool add(bool limited) {
    if (limited) {
      calm = 0;
      return ++stiff >= stiff_in_all;
    }
    if (stiff > 0 && ++calm == calm_in_a_row) restart();
    return false;
  }
  void restart() { stiff = calm = 0; }
};

}  // namespace flyball
