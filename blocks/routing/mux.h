#pragma once
#include "blocks/block.h"

namespace flyball {

struct Mux : Block {
  static constexpr auto summary = "Joins its inputs into one vector signal.";
  static constexpr std::array aliases{"Modelica.Blocks.Routing.Multiplex", "MUX", "MUX_f"};
  int width = count("inputs", 2, 1, 1000, "number of inputs");
  Inputs u = inputs("u", width, "any", "element");
  Outputs y = output_vector("y", width, "any", "the inputs as one vector");

  explicit Mux(Settings* settings) : Block(settings) {
    for (int k = 0; k < width; ++k) pass(u[k], y[k]);
  }
};

}  // namespace flyball
