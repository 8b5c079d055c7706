// Whatever stands in a wire: a diagram, or errors with positions.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "models/diagram.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace flyball;
  std::string wire;
  for (std::size_t k = 0; k < size; ++k) {
    const char c = static_cast<char>(data[k]);
    if (c != '\'' && (c >= ' ' || c == '\t')) wire += c;  // what a TOML string may hold
  }
  const std::string text =
      "flyball = 1\n"
      "[blocks]\n"
      "a = { type = \"Gain\" }\n"
      "b = { type = \"Sum\", signs = \"++\" }\n"
      "robot = { type = \"DifferentialDrive\" }\n"
      "split = { type = \"Demux\", outputs = 3 }\n"
      "[diagram]\n"
      "wires = ['" +
      wire + "']\n";
  Diagnostics diagnostics("model.toml");
  const bool read = read_diagram(text, diagnostics).has_value();
  if (read == diagnostics.failed()) std::abort();
  return 0;
}
