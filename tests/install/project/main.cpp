#include "blocks/block.h"
#include "blocks/jet_kernels.h"
#include "blocks/registry.h"
#include "tools/command_line.h"

/// A spring that stiffens: F = -k x - k3 x^3.
struct StiffeningSpring : flyball::Block {
  static constexpr auto summary = "A spring whose stiffness grows with its length.";
  using Block::Block;
  flyball::Param k = param("k", 1.0, "N/m", flyball::positive, "stiffness at rest");
  flyball::Param k3 = param("k3", 0.0, "N/m^3", flyball::any, "how it grows");
  flyball::Input x = input("x", "m", "length");
  flyball::Output F = output("F", "N", "force");

  void outputs(auto& v) const { v[F] = -v[k] * v[x] - v[k3] * v[x] * v[x] * v[x]; }
};

int main(int argc, char** argv) {
  flyball::add_block_type(flyball::describe<StiffeningSpring>("StiffeningSpring", "mechanics"));
  return flyball::run_command_line(argc, argv);
}
