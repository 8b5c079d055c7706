#pragma once

#include <compare>
#include <string>
#include <tuple>
#include <vector>

namespace flyball {

/// A place in a text, counted from 1. Line 0: the text as a whole.
struct Position {
  int line = 0;
  int column = 0;
  int source = 0;  // which text, of Diagnostics::add_source; 0 is the file that is checked

  bool operator==(const Position&) const = default;
  auto operator<=>(const Position& other) const {
    return std::tie(source, line, column) <=> std::tie(other.source, other.line, other.column);
  }
};

/// One thing wrong with a model.
struct Diagnostic {
  enum class Severity { error, warning, note };

  Severity severity = Severity::error;
  std::string file;
  Position at;
  std::string message;
};

/// `file:line:column: error: message`, the form that editors and compilers agree on.
std::string to_string(const Diagnostic& diagnostic);

/// Collects all that is wrong with a file and with the files that it uses, so that one run shows it all.
class Diagnostics {
 public:
  explicit Diagnostics(std::string file) : sources_{{std::move(file), {}, {}}} {}

  /// A text that is part of the model because it is used at `used`, under the name `as`. Notes behind each
  /// error in it lead from use to use to the file that is checked. A text that is used twice is two sources.
  int add_source(std::string file, Position used, std::string as);

  void error(Position at, std::string message);
  /// Belongs to the error or warning before it: where the other end was declared.
  void note(Position at, std::string message);
  void warning(Position at, std::string message);

  bool failed() const { return errors_ > 0; }
  /// Counts what is found again in another use of the same text, which `sorted` shows once.
  int errors() const { return errors_; }
  const std::string& file(int source = 0) const;
  /// By file in the order of first use, then by position; notes stay behind what they belong to.
  std::vector<Diagnostic> sorted() const;

 private:
  struct Source {
    std::string file;
    Position used;
    std::string as;
  };

  void add(Diagnostic::Severity severity, Position at, std::string message);
  void append_uses(int source, std::vector<Diagnostic>& result) const;

  std::vector<Source> sources_;
  int errors_ = 0;
  std::vector<std::vector<Diagnostic>> all_;  // each with its notes
};

/// How many errors a list shows.
int count_errors(const std::vector<Diagnostic>& diagnostics);

}  // namespace flyball
