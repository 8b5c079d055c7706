// Whatever the bytes: a diagram and perhaps a plan, or errors with positions.
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string_view>

#include "models/plan.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace flyball;
  Diagnostics diagnostics("model.toml");
  auto diagram = read_diagram(std::string_view(reinterpret_cast<const char*>(data), size), diagnostics);
  if (diagram.has_value() == diagnostics.failed()) std::abort();
  for (const Diagnostic& diagnostic : diagnostics.sorted()) {
    if (diagnostic.at.line < 1 || diagnostic.message.empty()) std::abort();
  }
  if (diagram) make_plan(std::make_shared<const Diagram>(*std::move(diagram)), diagnostics);
  return 0;
}
