#pragma once

#include <string>
#include <vector>

namespace flyball {

/// A place in a file, counted from 1. Line 0: the file as a whole.
struct Position {
  int line = 0;
  int column = 0;

  auto operator<=>(const Position&) const = default;
};

/// One thing wrong with a file.
struct Diagnostic {
  enum class Severity { error, warning, note };

  Severity severity = Severity::error;
  std::string file;
  Position at;
  std::string message;
};

/// `file:line:column: error: message`, the form that editors and compilers agree on.
std::string to_string(const Diagnostic& diagnostic);

/// Collects all that is wrong with a file, so that one run shows it all.
class Diagnostics {
 public:
  explicit Diagnostics(std::string file) : file_(std::move(file)) {}

  void error(Position at, std::string message);
  /// Belongs to the error before it: where the other end was declared.
  void note(Position at, std::string message);
  void warning(Position at, std::string message);

  bool failed() const { return errors_ > 0; }
  int errors() const { return errors_; }
  const std::string& file() const { return file_; }
  /// Sorted by position; notes stay behind their error.
  std::vector<Diagnostic> sorted() const;

 private:
  std::string file_;
  int errors_ = 0;
  std::vector<Diagnostic> all_;
};

}  // namespace flyball
