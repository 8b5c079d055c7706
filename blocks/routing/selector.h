#pragma once
#include "blocks/block.h"

namespace flyball {

struct Selector : Block {
  static constexpr auto summary = "Picks elements of a vector signal.";
  static constexpr std::array aliases{"Modelica.Blocks.Routing.ExtractSignal", "EXTRACTOR"};
  int width = count("width", 2, 1, 1000, "number of elements of the input");
  std::vector<int> indices =
      counts("indices", {1}, 1, width, "which elements, in their order, counted from 1");
  int picked = static_cast<int>(indices.size());
  Inputs u = input_vector("u", width, "any", "vector");
  Outputs y = picked == 1 ? Outputs(output("y", "any", "the element").slot, 1)
                          : output_vector("y", picked, "any", "the elements");

  explicit Selector(Settings* settings) : Block(settings) {
    for (int k = 0; k < picked; ++k) pass(u[indices[k] - 1], y[k]);
  }
};

}  // namespace flyball
