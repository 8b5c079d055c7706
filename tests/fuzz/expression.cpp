// Whatever the bytes: a formula that can be evaluated, or an error inside the text.
#include <cstdint>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "models/language/expression.h"
#include "models/language/quantity.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace flyball;
  static const NameIndex parameters = {{"V", 0}, {"K_H", 1}};
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  Scope scope;
  scope.parameters = &parameters;
  try {
    const Formula formula = parse_expression(text, scope);
    const std::size_t n = formula.operands.size();
    evaluate(formula, std::vector<double>(n, 0.5));
    evaluate_exact(formula, std::vector<std::optional<Rational>>(n, Rational(1)));
    infer(formula, std::vector<Quantity>(n));
  } catch (const TextError& error) {
    if (error.offset() > size) std::abort();
  }
  return 0;
}
