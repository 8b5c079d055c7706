// Recursive descent, one function a level of strength, without a lexer: what a word means depends on whether
// a number stands before it.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

#include "models/language/expression.h"
#include "models/language/formula_builder.h"
#include "models/language/literal.h"
#include "models/language/messages.h"

namespace flyball {
namespace {

using Op = Formula::Op;

struct Function {
  const char* name;
  int arguments;
  Op op;  // literal: written with choose and greater
};

constexpr std::array<Function, 20> functions{{
    {"sin", 1, Op::sin},      {"cos", 1, Op::cos},     {"tan", 1, Op::tan},     {"asin", 1, Op::asin},
    {"acos", 1, Op::acos},    {"atan", 1, Op::atan},   {"atan2", 2, Op::atan2}, {"sinh", 1, Op::sinh},
    {"cosh", 1, Op::cosh},    {"tanh", 1, Op::tanh},   {"exp", 1, Op::exp},     {"log", 1, Op::log},
    {"log10", 1, Op::log10},  {"sqrt", 1, Op::sqrt},   {"hypot", 2, Op::hypot}, {"abs", 1, Op::literal},
    {"sign", 1, Op::literal}, {"min", 2, Op::literal}, {"max", 2, Op::literal}, {"if", 3, Op::choose},
}};

/// A node, and whether it is a condition or a number.
struct Part {
  int node = -1;
  bool condition = false;
  std::size_t offset = 0;
};

class ExpressionParser {
 public:
  ExpressionParser(std::string_view text, const Scope& scope, std::size_t at = 0)
      : text_(text),
        scope_(scope),
        ends_unit_([&scope](std::string_view name) {
          return is_reserved(name) || (!scope.of_signals && scope.knows(name));
        }),
        build_(text),
        at_(at) {}

  Formula run() {
    const Part whole = disjunction();
    if (skip_space(); at_ < text_.size()) throw TextError(at_, unexpected());
    number(whole);
    return build_.finish();
  }

  Formula run_part(Wanted wanted, std::size_t& behind) {
    if (wanted == Wanted::number) {
      number(sum());
    } else {
      const int holds = condition(disjunction());
      const std::size_t offset = build_.node(holds).offset;
      const int one = whole(1, offset), zero = whole(0, offset);
      build_.add(Op::choose, offset, holds, one, zero);
    }
    behind = at_;
    return build_.finish();
  }

 private:
  /// One level of recursion, so that no text can exhaust the stack.
  class Deeper {
   public:
    explicit Deeper(ExpressionParser& parser) : depth_(parser.depth_) {
      constexpr int deepest = 200;
      if (++depth_ > deepest) throw TextError(parser.at_, message::expression_too_deep());
    }
    ~Deeper() { --depth_; }

   private:
    int& depth_;
  };

  Part disjunction() {
    Part left = conjunction();
    while (take_word("or")) left = both_conditions(Op::either, left, conjunction());
    return left;
  }

  Part conjunction() {
    Part left = negation();
    while (take_word("and")) left = both_conditions(Op::both, left, negation());
    return left;
  }

  Part both_conditions(Op op, const Part& a, const Part& b) {
    return {build_.add(op, a.offset, condition(a), condition(b)), true, a.offset};
  }

  Part negation() {
    const Deeper level(*this);
    skip_space();
    const std::size_t offset = at_;
    if (!take_word("not")) return comparison();
    return {build_.add(Op::opposite, offset, condition(negation())), true, offset};
  }

  Part comparison() {
    const Part left = sum();
    skip_space();
    const std::size_t offset = at_;
    const bool above = next_is('>');
    if (next_is('=') || next_is('!')) throw TextError(at_, message::no_equality());
    if (!above && !next_is('<')) return left;
    ++at_;
    const bool or_equal = take('=');
    const int a = number(left);
    const int b = number(sum());
    if (skip_space(); next_is('<') || next_is('>')) throw TextError(at_, message::chained_comparison());
    // a >= b is not (b > a).
    int node = above != or_equal ? build_.greater(offset, a, b) : build_.greater(offset, b, a);
    if (or_equal) node = build_.add(Op::opposite, offset, node);
    return {node, true, left.offset};
  }

  Part sum() {
    Part left = term();
    while (true) {
      skip_space();
      const std::size_t offset = at_;
      if (!next_is('+') && !next_is('-')) return left;
      const Op op = text_[at_++] == '+' ? Op::add : Op::subtract;
      const int a = number(left);
      left = {build_.add(op, offset, a, number(term())), false, left.offset};
    }
  }

  Part term() {
    Part left = signed_factor(true);
    while (true) {
      skip_space();
      const std::size_t offset = at_;
      if (!next_is('*') && !next_is('/')) return left;
      const Op op = text_[at_++] == '*' ? Op::multiply : Op::divide;
      const int a = number(left);
      left = {build_.add(op, offset, a, number(signed_factor(false))), false, left.offset};
    }
  }

  Part signed_factor(bool first) {
    const Deeper level(*this);
    skip_space();
    const std::size_t offset = at_;
    if (take('+')) return {number(signed_factor(first)), false, offset};
    if (!take('-')) return raised(first);
    return {build_.negative(offset, number(signed_factor(first))), false, offset};
  }

  Part raised(bool first) {
    const Part base = primary(first);
    skip_space();
    const std::size_t offset = at_;
    if (!take('^')) return base;
    const int a = number(base);
    return {build_.power(offset, a, number(signed_factor(false))), false, base.offset};
  }

  Part primary(bool first) {
    skip_space();
    const std::size_t offset = at_;
    if (take('(')) {
      Part inside = disjunction();
      expect(')');
      inside.offset = offset;
      return inside;
    }
    if (at_ < text_.size() && (std::isdigit(static_cast<unsigned char>(text_[at_])) != 0 || next_is('.'))) {
      return {build_.literal(parse_literal(text_, at_, first, ends_unit_)), false, offset};
    }
    const std::string_view name = take_name();
    if (name.empty()) throw TextError(at_, unexpected());
    if (skip_space(); next_is('(')) return {call(name, offset), false, offset};
    return {value_of(name, offset), false, offset};
  }

  int value_of(std::string_view name, std::size_t offset) {
    if (scope_.knows(name)) return build_.operand(name, offset);
    Formula::Node constant;
    constant.offset = static_cast<int>(offset);
    constant.value = name == "pi" ? M_PI : M_E;
    if (name == "pi" || name == "e") return build_.literal(std::move(constant));
    throw TextError(offset, message::unknown_name(name, scope_.names()));
  }

  int call(std::string_view name, std::size_t offset) {
    if (scope_.calls != nullptr) {
      std::size_t behind = at_ + 1;
      if (const auto operand = scope_.calls->read(name, text_, behind)) {
        at_ = behind;
        return build_.operand(*operand, offset);
      }
    }
    const auto* function = std::ranges::find(functions, name, &Function::name);
    if (function == functions.end()) throw TextError(offset, message::unknown_function(name, callable()));
    take('(');
    std::vector<int> arguments;
    do {
      const Part part = disjunction();
      const bool wants_condition = function->op == Op::choose && arguments.empty();
      arguments.push_back(wants_condition ? condition(part) : number(part));
    } while (take(','));
    expect(')');
    if (static_cast<int>(arguments.size()) != function->arguments) {
      throw TextError(offset,
                      message::argument_count(name, function->arguments, static_cast<int>(arguments.size())));
    }
    arguments.resize(3, -1);
    if (function->op == Op::literal) return kinked(name, offset, arguments[0], arguments[1]);
    return build_.add(function->op, offset, arguments[0], arguments[1], arguments[2]);
  }

  std::vector<std::string> callable() const {
    std::vector<std::string> all = function_names();
    if (scope_.calls == nullptr) return all;
    const std::vector<std::string> more = scope_.calls->names();
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  /// The functions with a kink: each comparison is one that the engine can locate.
  int kinked(std::string_view name, std::size_t offset, int a, int b) {
    if (name == "min") return build_.add(Op::choose, offset, build_.greater(offset, a, b), b, a);
    if (name == "max") return build_.add(Op::choose, offset, build_.greater(offset, b, a), b, a);
    const int zero = whole(0, offset);
    if (name == "abs") {
      const int opposite = build_.add(Op::negate, offset, a);
      return build_.add(Op::choose, offset, build_.greater(offset, zero, a), opposite, a);
    }
    const int below = build_.greater(offset, zero, a);
    const int not_above = build_.add(Op::choose, offset, below, whole(-1, offset), zero);
    return build_.add(Op::choose, offset, build_.greater(offset, a, zero), whole(1, offset), not_above);
  }

  int whole(int value, std::size_t offset) {
    Formula::Node node;
    node.offset = static_cast<int>(offset);
    node.value = value;
    node.exact = Rational(value);
    return build_.literal(std::move(node));
  }

  int number(const Part& part) {
    if (part.condition) throw TextError(part.offset, message::expected_number());
    return part.node;
  }
  int condition(const Part& part) {
    if (!part.condition) throw TextError(part.offset, message::expected_condition());
    return part.node;
  }

  std::string unexpected() const {
    return at_ < text_.size() ? message::unexpected(first_character(text_.substr(at_)))
                              : message::expression_ends();
  }
  void skip_space() {
    while (at_ < text_.size() && std::string_view(" \t\r\n").find(text_[at_]) != std::string_view::npos)
      ++at_;
  }
  bool next_is(char c) const { return at_ < text_.size() && text_[at_] == c; }
  bool take(char c) {
    skip_space();
    return next_is(c) && ++at_ > 0;
  }
  void expect(char c) {
    if (!take(c)) throw TextError(at_, message::expected_before(c, unexpected()));
  }
  std::string_view take_name() {
    std::size_t length = leading_name(text_.substr(at_)).size();
    while (scope_.of_signals && length > 0 && at_ + length < text_.size() && text_[at_ + length] == '.') {
      const std::size_t more = leading_word(text_.substr(at_ + length + 1));
      if (more == 0) break;
      length += 1 + more;
    }
    at_ += length;
    return text_.substr(at_ - length, length);
  }
  /// Letters, digits and _: elements of a signal may be numbers.
  static std::size_t leading_word(std::string_view text) {
    const auto ends = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '_'; };
    return static_cast<std::size_t>(std::ranges::find_if(text, ends) - text.begin());
  }
  bool take_word(std::string_view word) {
    skip_space();
    const std::size_t before = at_;
    if (take_name() == word) return true;
    at_ = before;
    return false;
  }

  std::string_view text_;
  const Scope& scope_;
  EndsUnit ends_unit_;
  FormulaBuilder build_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

}  // namespace

Formula parse_expression(std::string_view text, const Scope& scope) {
  if (auto celsius = parse_celsius(text)) {
    FormulaBuilder build(text);
    build.literal(std::move(*celsius));
    return build.finish();
  }
  return ExpressionParser(text, scope).run();
}

Formula parse_part(std::string_view text, std::size_t& at, const Scope& scope, Wanted wanted) {
  return ExpressionParser(text, scope, at).run_part(wanted, at);
}

const std::vector<std::string>& function_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Function& function : functions) all.emplace_back(function.name);
    return all;
  }();
  return names;
}

}  // namespace flyball
