#pragma once

#include <algorithm>
#include <random>
#include <string>
#include <vector>

namespace flyball::test {

/// Changes a text at random, as slips and damage do. The same seed gives the same changes.
class Mutator {
 public:
  explicit Mutator(unsigned seed) : random_(seed) {}

  std::string mutate(std::string text) {
    const std::size_t at = text.empty() ? 0 : static_cast<std::size_t>(below(text.size()));
    switch (below(11)) {
      case 0:
        return edit_lines(text, [&](auto& lines) { lines.erase(lines.begin() + below(lines.size())); });
      case 1:
        return edit_lines(text, [&](auto& lines) {
          const std::string line = lines[below(lines.size())];
          lines.insert(lines.begin() + below(lines.size()), line);
        });
      case 2:
        return edit_lines(
            text, [&](auto& lines) { std::swap(lines[below(lines.size())], lines[below(lines.size())]); });
      case 3:
        text[below(text.size())] = static_cast<char>(below(256));
        return text;
      case 4:
        text[below(text.size())] = "\"'[]{}=.,()->+*/^#\n0eE "[below(24)];
        return text;
      case 5:
        return text.insert(at, 1, '\0');
      case 6:
        return text.insert(at, "\xEF\xBB\xBF");
      case 7:
        return text.insert(at, "\r\n");
      case 8:
        return text.insert(at, std::string(static_cast<std::size_t>(below(200)), "[{("[below(3)]));
      case 9:  // another type of value
        return text.insert(std::min(text.find("= ", at), text.size()), "= [1, \"two\", { x = true }] #");
      default:
        return text.substr(0, below(text.size()));
    }
  }

 private:
  int below(std::size_t n) { return static_cast<int>(random_() % n); }

  template <class Edit>
  static std::string edit_lines(const std::string& text, Edit edit) {
    std::vector<std::string> lines;
    std::size_t start = 0;
    for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n', start)) {
      lines.push_back(text.substr(start, end + 1 - start));
      start = end + 1;
    }
    if (!lines.empty()) edit(lines);
    std::string result;
    for (const std::string& line : lines) result += line;
    return result;
  }

  std::mt19937 random_;
};

}  // namespace flyball::test
