// Whatever the bytes: a table of finite numbers, or errors with positions.
#include "models/language/csv.h"

#include <cmath>
#include <cstdint>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace flyball;
  Diagnostics diagnostics("table.csv");
  const auto table = read_csv(std::string_view(reinterpret_cast<const char*>(data), size), diagnostics);
  if (table.has_value() == diagnostics.failed()) std::abort();
  if (!table) return 0;
  for (const double number : table->numbers) {
    if (!std::isfinite(number)) std::abort();
  }
  return 0;
}
