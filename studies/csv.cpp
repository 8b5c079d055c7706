#include "studies/csv.h"

#include <algorithm>
#include <charconv>

namespace flyball {
namespace {

// The longest shortest form is "-2.2250738585072014e-308"; and a separator.
constexpr std::size_t longest_number = 25;

}  // namespace

std::string to_csv(const Log& log) {
  std::string header = "time";
  for (const LogColumn& column : log.columns()) header += "," + column.name;
  header += '\n';

  std::string text(header.size() + log.data().size() * longest_number, '\0');
  char* at = std::ranges::copy(header, text.data()).out;
  char* const end = text.data() + text.size();
  const int fields = log.width() + 1;
  int field = 0;
  for (const double x : log.data()) {
    at = std::to_chars(at, end, x).ptr;
    const bool last = ++field == fields;
    *at++ = last ? '\n' : ',';
    if (last) field = 0;
  }
  text.resize(static_cast<std::size_t>(at - text.data()));
  return text;
}

}  // namespace flyball
