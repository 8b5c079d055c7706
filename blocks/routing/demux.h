#pragma once
#include "blocks/block.h"

namespace flyball {

struct Demux : Block {
  static constexpr auto summary = "Splits a vector signal into its elements.";
  static constexpr std::array aliases{"Modelica.Blocks.Routing.DeMultiplex", "DEMUX", "DEMUX_f"};
  int width = count("outputs", 2, 1, 1000, "number of elements");
  Inputs u = input_vector("u", width, "any", "vector");
  Outputs y = outputs_each("y", width, "any", "element of the vector");

  explicit Demux(Settings* settings) : Block(settings) {
    for (int k = 0; k < width; ++k) pass(u[k], y[k]);
  }
};

}  // namespace flyball
