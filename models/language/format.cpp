#include "models/language/format.h"

#include <algorithm>
#include <cctype>
#include <utility>
#include <vector>

namespace flyball {
namespace {

struct Item;

/// A value as it is written. Lists and inline tables hold items; all else is verbatim text.
struct Value {
  std::string text;
  char bracket = 0;  // '[', '{' or none
  std::vector<Item> items;
  bool broken = false;                // over several lines
  std::vector<std::string> comments;  // behind the last item
};

struct Item {
  std::vector<std::string> comments;  // on lines of their own before it
  std::string key;                    // of an inline table
  Value value;
  std::string comment;     // behind it, on its line
  bool ends_line = false;  // a line break follows
};

/// What stands on one line of the text, or on several for a broken value.
struct Statement {
  enum class Kind { blank, comment, header, entry };

  Kind kind = Kind::blank;
  std::string text;  // of a comment or header, or the key
  Value value;
  std::string comment;
};

/// Cuts a valid text into statements.
class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {
    if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;
  }

  std::vector<Statement> read() {
    std::vector<Statement> all;
    while (skip_blanks(), at_ < text_.size()) all.push_back(statement());
    return all;
  }

 private:
  char peek() const { return at_ < text_.size() ? text_[at_] : '\n'; }
  bool at_end_of_line() const {
    return at_ >= text_.size() || peek() == '\n' || text_.substr(at_, 2) == "\r\n";
  }
  void skip_blanks() {
    while (at_ < text_.size() && (peek() == ' ' || peek() == '\t')) ++at_;
  }
  void end_line() { at_ = std::min(text_.find('\n', at_), text_.size() - 1) + 1; }

  Statement statement() {
    Statement s;
    if (!at_end_of_line()) {
      s.kind = peek() == '#'   ? Statement::Kind::comment
               : peek() == '[' ? Statement::Kind::header
                               : Statement::Kind::entry;
    }
    if (s.kind == Statement::Kind::comment) {
      s.text = comment();
    } else if (s.kind == Statement::Kind::header) {
      const int depth = text_.substr(at_, 2) == "[[" ? 2 : 1;
      at_ += static_cast<std::size_t>(depth);
      s.text = std::string(depth, '[') + key() + std::string(depth, ']');
      at_ += static_cast<std::size_t>(depth);
    } else if (s.kind == Statement::Kind::entry) {
      s.text = key();
      ++at_;  // the equals sign
      skip_blanks();
      s.value = value();
    }
    skip_blanks();
    if (peek() == '#') s.comment = comment();
    end_line();
    return s;
  }

  std::string comment() {
    const std::size_t begin = at_;
    at_ = std::min(text_.find('\n', at_), text_.size());
    std::string_view result = text_.substr(begin, at_ - begin);
    while (!result.empty() && std::isspace(static_cast<unsigned char>(result.back())) != 0)
      result.remove_suffix(1);
    return std::string(result);
  }

  /// A key with its dots, up to the equals sign or bracket behind it.
  std::string key() {
    std::string result;
    for (skip_blanks(); peek() != '=' && peek() != ']'; skip_blanks()) {
      const bool quoted = peek() == '"' || peek() == '\'';
      result += quoted ? string() : std::string(1, text_[at_++]);
    }
    return result;
  }

  /// A string of any of the four kinds, verbatim.
  std::string string() {
    const std::size_t begin = at_;
    const char quote = peek();
    const std::string three(3, quote);
    const bool lines = text_.substr(at_, 3) == three;
    for (at_ += lines ? 3 : 1; lines ? text_.substr(at_, 3) != three : peek() != quote; ++at_) {
      if (quote == '"' && peek() == '\\') ++at_;
    }
    at_ += lines ? 3 : 1;
    // Up to two quotes may stand right before the closing ones.
    while (lines && at_ < text_.size() && peek() == quote) ++at_;
    return std::string(text_.substr(begin, at_ - begin));
  }

  Value value() {
    Value result;
    if (peek() == '[' || peek() == '{') {
      collection(result);
    } else if (peek() == '"' || peek() == '\'') {
      result.text = string();
    } else {
      result.text = bare();
    }
    return result;
  }

  /// A number, truth value or date; a date and its time may have a blank between them.
  std::string bare() {
    const std::size_t begin = at_;
    const auto ends = [&] {
      return at_end_of_line() || std::string_view(" \t,]}#").find(peek()) != std::string_view::npos;
    };
    while (!ends()) ++at_;
    const bool date = at_ - begin == 10 && text_[begin + 4] == '-' && peek() == ' ';
    if (date && at_ + 1 < text_.size() && std::isdigit(static_cast<unsigned char>(text_[at_ + 1])) != 0) {
      for (++at_; !ends();) ++at_;
    }
    return std::string(text_.substr(begin, at_ - begin));
  }

  void collection(Value& result) {
    result.bracket = text_[at_++];
    const char closing = result.bracket == '[' ? ']' : '}';
    Item item;
    for (;;) {
      separators(result, item);
      if (peek() == closing) break;
      if (result.bracket == '{') {
        item.key = key();
        ++at_;
        skip_blanks();
      }
      item.value = value();
      result.items.push_back(std::exchange(item, {}));
    }
    ++at_;
    result.comments = std::move(item.comments);
  }

  /// What stands between two items: blanks, the comma, line breaks and comments.
  void separators(Value& result, Item& next) {
    bool new_line = false;
    for (;; ++at_) {
      skip_blanks();
      if (peek() == '#') {
        const bool behind = !new_line && !result.items.empty();
        (behind ? result.items.back().comment : next.comments.emplace_back()) = comment();
        result.broken = true;
      }
      if (at_end_of_line()) {
        new_line = result.broken = true;
        if (!result.items.empty()) result.items.back().ends_line = true;
        at_ = text_.find('\n', at_);
      } else if (peek() != ',') {
        return;
      }
    }
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

/// Characters of a text, as far as columns are concerned.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

class Writer {
 public:
  std::string write(const std::vector<Statement>& statements) {
    for (std::size_t k = 0; k < statements.size(); ++k) {
      const Statement& s = statements[k];
      if (s.kind == Statement::Kind::entry) {
        align(statements, k);
        text_ += s.text + std::string(aligned_ - std::min(aligned_, width(s.text)), ' ') + " = ";
        value(s.value, 1);
      } else {
        if (s.kind == Statement::Kind::header) separate();
        text_ += s.text;
      }
      if (!s.comment.empty()) text_ += "  " + s.comment;
      text_ += '\n';
    }
    return tidy();
  }

 private:
  static bool in_line(const Statement& s) { return s.kind == Statement::Kind::entry && !s.value.broken; }

  /// Entries on lines that follow each other have their equals signs below each other.
  void align(const std::vector<Statement>& all, std::size_t k) {
    if (!in_line(all[k])) {
      aligned_ = 0;
    } else if (k == 0 || !in_line(all[k - 1])) {
      aligned_ = 0;
      for (std::size_t n = k; n < all.size() && in_line(all[n]); ++n)
        aligned_ = std::max(aligned_, width(all[n].text));
    }
  }

  /// A section begins behind a blank line, or behind the comment that belongs to it.
  void separate() {
    if (text_.empty() || text_.ends_with("\n\n")) return;
    const std::size_t line = text_.rfind('\n', text_.size() - 2);
    const bool behind_comment = text_[line == std::string::npos ? 0 : line + 1] == '#';
    if (!behind_comment) text_ += '\n';
  }

  void value(const Value& v, int depth) {
    if (v.bracket == 0) {
      text_ += v.text;
    } else if (v.broken) {
      broken(v, depth);
    } else {
      const char* blank = v.bracket == '{' && !v.items.empty() ? " " : "";
      text_ += v.bracket;
      text_ += blank;
      for (std::size_t k = 0; k < v.items.size(); ++k) {
        if (k > 0) text_ += ", ";
        item(v.items[k], depth);
      }
      text_ += blank;
      text_ += v.bracket == '[' ? ']' : '}';
    }
  }

  void item(const Item& i, int depth) {
    if (!i.key.empty()) text_ += i.key + " = ";
    value(i.value, depth);
  }

  void broken(const Value& v, int depth) {
    const std::string indent(2 * static_cast<std::size_t>(depth), ' ');
    text_ += v.bracket;
    text_ += '\n';
    bool begins = true;
    for (std::size_t k = 0; k < v.items.size(); ++k) {
      const Item& i = v.items[k];
      for (const std::string& comment : i.comments) text_ += indent + comment + '\n';
      text_ += begins ? indent : " ";
      item(i, depth + 1);
      text_ += ',';
      if (!i.comment.empty()) text_ += "  " + i.comment;
      begins = i.ends_line || !i.comment.empty() || k + 1 == v.items.size();
      if (begins) text_ += '\n';
    }
    for (const std::string& comment : v.comments) text_ += indent + comment + '\n';
    text_ += std::string(2 * (static_cast<std::size_t>(depth) - 1), ' ') + (v.bracket == '[' ? ']' : '}');
  }

  /// No blank lines at the ends.
  std::string tidy() {
    while (text_.ends_with("\n\n")) text_.pop_back();
    return text_ == "\n" ? std::string() : text_;
  }

  std::string text_;
  std::size_t aligned_ = 0;  // where the equals sign of this line stands
};

/// No blank lines at the beginning, and never two in a row.
void drop_blank_lines(std::vector<Statement>& statements) {
  const auto blank = [](const Statement& s) { return s.kind == Statement::Kind::blank; };
  std::size_t kept = 0;
  for (Statement& s : statements) {
    if (blank(s) && (kept == 0 || blank(statements[kept - 1]))) continue;
    if (&s != &statements[kept]) statements[kept] = std::move(s);
    ++kept;
  }
  statements.resize(kept);
}

}  // namespace

std::string format_toml(std::string_view text) {
  std::vector<Statement> statements = Reader(text).read();
  drop_blank_lines(statements);
  return Writer().write(statements);
}

}  // namespace flyball
