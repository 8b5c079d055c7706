#include "studies/metrics/requirement_parser.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "models/language/messages.h"
#include "models/language/names.h"
#include "models/language/units.h"
#include "studies/metrics/messages.h"

namespace flyball {
namespace {

constexpr std::array<std::string_view, 6> words{"and", "after", "before", "between", "within", "matches"};

std::string_view trimmed(std::string_view text) {
  const std::size_t first = std::min(text.find_first_not_of(" \t\r\n"), text.size());
  return text.substr(first, text.find_last_not_of(" \t\r\n") + 1 - first);
}

/// The first of `words` as a whole word outside quotes and parentheses, from `at` on; the end without one.
std::size_t find_word(std::string_view text, std::size_t at) {
  for (int depth = 0; at < text.size(); ++at) {
    const char c = text[at];
    if (c == '"' || c == '\'') at = std::min(text.find(c, at + 1), text.size() - 1);
    if (c == '(') ++depth;
    if (c == ')') --depth;
    const std::string_view name = leading_name(text.substr(at));
    if (depth == 0 && std::ranges::find(words, name) != words.end()) return at;
    if (!name.empty()) at += name.size() - 1;
  }
  return text.size();
}

/// "5 %" is a number that people want to see in "%".
DisplayUnit unit_of_bound(std::string_view bound) {
  double value = 0.0;
  bound = trimmed(bound);
  if (bound.starts_with('-') || bound.starts_with('+')) bound.remove_prefix(1);
  const auto [end, error] = std::from_chars(bound.data(), bound.data() + bound.size(), value);
  const std::string_view unit = trimmed(bound.substr(static_cast<std::size_t>(end - bound.data())));
  if (error != std::errc() || unit.empty()) return {};
  try {
    const Unit parsed = parse_unit(unit);
    if (parsed.offset == 0.0) return {parsed.factor, std::string(unit)};
  } catch (const TextError&) {
    // A longer expression, which has no unit of its own.
  }
  return {};
}

class ClauseParser {
 public:
  ClauseParser(std::string_view text, SeriesParser& parser) : text_(text), parser_(parser) {}

  std::vector<Clause> run() {
    std::vector<Clause> clauses;
    do {
      clauses.push_back(clause());
      clauses.back().si_unit = unit_of(quantity_);
      require_same_dimension(clauses.size() == 1);
    } while (take_word("and"));
    if (at_ < text_.size()) throw TextError(at_, message::unexpected(first_character(text_.substr(at_))));
    return clauses;
  }

 private:
  using When = Comparison::When;

  bool take_word(std::string_view word) {
    at_ = parser_.skip_space(at_);
    if (leading_name(text_.substr(at_)) != word) return false;
    at_ += word.size();
    return true;
  }

  Clause clause() {
    begin_ = parser_.skip_space(at_);
    const When when = take_word("always")       ? When::always
                      : take_word("eventually") ? When::eventually
                                                : When::number;
    const std::size_t end = find_word(text_, at_);
    const std::string_view word = leading_name(text_.substr(end));
    if (when == When::number && (word == "within" || word == "matches")) return containment(end);
    return comparison(when, end);
  }

  Clause comparison(When when, std::size_t end) {
    Comparison result;
    result.when = when;
    Clause clause;
    while (true) {
      result.sides.push_back(when == When::number ? parser_.number(at_, end) : parser_.expression(at_, end));
      const SeriesExpression& side = result.sides.back();
      result.side_texts.emplace_back(trimmed(text_.substr(side.begin, side.end - side.begin)));
      if (side.operands.empty()) clause.unit = unit_of_bound(result.side_texts.back());
      if (result.sides.size() > 1) parser_.require_dimension(side, quantity_of(result));
      if (at_ >= end || (text_[at_] != '<' && text_[at_] != '>')) break;
      result.relations.push_back(relation());
    }
    if (result.relations.empty())
      throw TextError(at_, at_ < end ? message::unexpected(first_character(text_.substr(at_)))
                                     : message::expected_relation());
    quantity_ = quantity_of(result);
    if (clause.unit.name.empty()) clause.unit = si_unit();
    if (when != When::number) window(result);
    clause.statement = std::move(result);
    return clause;
  }

  /// Of the first side whose dimension is known.
  static Quantity quantity_of(const Comparison& comparison) {
    const auto known = std::ranges::find_if(
        comparison.sides, [](const SeriesExpression& side) { return side.quantity.known(); });
    return known == comparison.sides.end() ? comparison.sides[0].quantity : known->quantity;
  }

  Order relation() {
    const bool less = text_[at_++] == '<';
    const bool or_equal = at_ < text_.size() && text_[at_] == '=';
    if (or_equal) ++at_;
    if (less) return or_equal ? Order::less_equal : Order::less;
    return or_equal ? Order::greater_equal : Order::greater;
  }

  void window(Comparison& comparison) {
    if (take_word("after")) {
      comparison.from = time(find_word(text_, at_));
    } else if (take_word("before")) {
      comparison.to = time(find_word(text_, at_));
    } else if (take_word("between")) {
      comparison.from = time(find_word(text_, at_));
      if (!take_word("and")) throw TextError(at_, message::expected_window("between"));
      comparison.to = time(find_word(text_, at_));
    }
  }

  SeriesExpression time(std::size_t end) {
    SeriesExpression result = parser_.number(at_, end);
    parser_.require_dimension(result, Quantity("s"));
    return result;
  }

  Clause containment(std::size_t end) {
    Containment result;
    result.signal = parser_.expression(at_, end);
    quantity_ = result.signal.quantity;
    result.signal_text = trimmed(text_.substr(result.signal.begin, result.signal.end - result.signal.begin));
    if (at_ < end) throw TextError(at_, message::unexpected(first_character(text_.substr(at_))));
    const bool within = take_word("within");
    if (!within) take_word("matches");
    at_ = parser_.skip_space(at_);
    const std::size_t file_at = at_;
    const std::filesystem::path file = parser_.file_name(at_, text_.size());
    result.file = file.filename().string();
    std::string column = result.signal_text;
    Tube tolerances;
    if (!within) read_tolerances(tolerances, column);
    result.tube = read_tube(file, within ? "" : column, file_at, tolerances);
    return {std::move(result), display_.name.empty() ? si_unit() : display_, {}};
  }

  std::shared_ptr<const Tube> read_tube(const std::filesystem::path& file, const std::string& column,
                                        std::size_t file_at, const Tube& tolerances) const {
    try {
      Tube tube = column.empty() ? read_envelope(file) : read_baseline(file, column);
      tube.absolute = tolerances.absolute;
      tube.relative = tolerances.relative;
      tube.time = tolerances.time;
      const Quantity found(tube.any().unit);
      if (found.known() && quantity_.known() && found.dimension != quantity_.dimension)
        throw TextError(
            file_at, message::column_dimension(to_string(quantity_.dimension), to_string(found.dimension)));
      return std::make_shared<const Tube>(std::move(tube));
    } catch (const TextError&) {
      throw;
    } catch (const std::runtime_error& error) {
      throw TextError(file_at, message::in_file(error.what()));
    }
  }

  /// "(absolute 1 mm, relative 1 %, time 10 ms, column shaft)"
  void read_tolerances(Tube& tube, std::string& column) {
    display_ = {};
    if (at_ >= text_.size() || text_[at_] != '(') return;
    const std::size_t close = std::min(text_.find(')', at_), text_.size());
    do {
      at_ = parser_.skip_space(at_ + 1);
      const std::string_view name = leading_name(text_.substr(at_));
      if (name == "absolute") {
        const std::size_t begin = at_ + name.size(), end = std::min(text_.find(',', at_), close);
        display_ = unit_of_bound(text_.substr(begin, end - begin));
        tube.absolute = tolerance(name, quantity_);
      } else if (name == "relative") {
        const std::size_t offset = at_;
        tube.relative = tolerance(name, Quantity("1"));
        if (tube.relative >= 1.0) throw TextError(offset, message::relative_too_large());
      } else if (name == "time") {
        tube.time = tolerance(name, Quantity("s"));
      } else if (name == "column") {
        at_ += name.size();
        column = parser_.file_name(at_, close).filename().string();
      } else {
        throw TextError(at_, message::expected_tolerance(first_word()));
      }
    } while (at_ < close && text_[at_] == ',');
    if (at_ != close || close == text_.size())
      throw TextError(at_, message::expected_before(')', message::expression_ends()));
    ++at_;
  }

  std::string_view first_word() const {
    const std::string_view name = leading_name(text_.substr(at_));
    return name.empty() ? first_character(text_.substr(at_)) : name;
  }

  double tolerance(std::string_view name, const Quantity& wanted) {
    at_ += name.size();
    const std::size_t end = std::min(text_.find_first_of(",)", at_), text_.size());
    const SeriesExpression value = parser_.expression(at_, end);
    parser_.require_number(value);
    parser_.require_dimension(value, wanted);
    if (!value.operands.empty()) throw TextError(value.begin, message::expected_literal());
    const double result = evaluate(value.formula, {});
    if (!(result >= 0.0)) throw TextError(value.begin, message::tolerance_negative(name));
    return result;
  }

  /// Margins of different kinds of quantities could not be compared.
  void require_same_dimension(bool is_first) {
    if (is_first) {
      first_ = quantity_;
    } else if (first_.known() && quantity_.known() && first_.dimension != quantity_.dimension) {
      throw TextError(
          begin_, message::different_clauses(to_string(first_.dimension), to_string(quantity_.dimension)));
    }
  }

  DisplayUnit si_unit() const {
    const std::string unit = unit_of(quantity_);
    return {1.0, unit == "1" ? "" : unit};
  }

  std::string_view text_;
  SeriesParser& parser_;
  std::size_t at_ = 0;
  std::size_t begin_ = 0;     // of the clause
  Quantity quantity_;         // of the clause
  Quantity first_;            // of the first clause
  DisplayUnit display_ = {};  // of the absolute tolerance
};

}  // namespace

std::vector<Clause> parse_clauses(std::string_view text, SeriesParser& parser) {
  return ClauseParser(text, parser).run();
}

}  // namespace flyball
