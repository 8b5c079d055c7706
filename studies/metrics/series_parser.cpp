#include "studies/metrics/series_parser.h"

#include <algorithm>

#include "models/language/formula_builder.h"
#include "models/language/literal.h"
#include "models/language/messages.h"
#include "models/language/names.h"
#include "studies/metrics/messages.h"

namespace flyball {
namespace {

using Kind = MeasureParameter::Kind;
using Operand = SeriesExpression::Operand;

/// The window of a call, besides its parameters.
constexpr std::string_view window_from = "from", window_to = "to";

/// Where the list of arguments that begins at `at` ends: at its parenthesis, or at the end of the text.
/// Counts those without a name.
std::size_t end_of_arguments(std::string_view text, std::size_t at, int& unnamed) {
  int depth = 0;
  bool named = false, empty = true;
  unnamed = 0;
  for (; at < text.size(); ++at) {
    const char c = text[at];
    if (c == '"' || c == '\'') at = std::min(text.find(c, at + 1), text.size() - 1);
    if (depth == 0 && (c == ')' || c == ',')) {
      if (!empty && !named) ++unnamed;
      if (c == ')') break;
      named = false;
      empty = true;
      continue;
    }
    if (c == '(') ++depth;
    if (c == ')') --depth;
    if (depth == 0 && c == '=') named = true;
    if (c != ' ') empty = false;
  }
  return at;
}

/// A signal may have a unit with broken exponents, which no expression can name.
Quantity signal_quantity(const std::string& unit) {
  try {
    return Quantity(unit);
  } catch (const TextError&) {
    return {};
  }
}

/// Whether the language has a function of this name that takes other arguments: min(a, b) is one of two
/// numbers, min(a) the least value of a signal.
bool means_language(std::string_view name, int unnamed) {
  return (name == "min" || name == "max") && unnamed != 1;
}

}  // namespace

SeriesParser::SeriesParser(std::string_view text, const std::vector<LogColumn>& columns,
                           const std::filesystem::path& folder)
    : text_(text), columns_(columns), folder_(folder) {
  for (const LogColumn& column : columns) signals_.push_back(column.name);
  signals_.emplace_back("time");
}

std::size_t SeriesParser::skip_space(std::size_t at) const {
  return std::min(text_.find_first_not_of(" \t\r\n", at), text_.size());
}

Operand SeriesParser::operand_named(const std::string& name) const {
  if (name == "time") return {Operand::Kind::time, 0};
  if (name.starts_with('#')) {
    const int call = std::stoi(name.substr(1));
    const bool series = calls_[static_cast<std::size_t>(call)].measure->series != nullptr;
    return {series ? Operand::Kind::series : Operand::Kind::number, call};
  }
  const auto found = std::ranges::find(columns_, name, &LogColumn::name);
  return {Operand::Kind::column, static_cast<int>(found - columns_.begin())};
}

Quantity SeriesParser::quantity_of(const Operand& operand) const {
  const auto index = static_cast<std::size_t>(operand.index);
  if (operand.kind == Operand::Kind::time) return Quantity("s");
  return operand.kind == Operand::Kind::column ? signal_quantity(columns_[index].unit)
                                               : calls_[index].quantity;
}

SeriesExpression SeriesParser::expression(std::size_t& at, std::size_t end, Wanted wanted) {
  Scope scope;
  scope.inputs = signals_;
  scope.calls = this;
  scope.of_signals = true;
  SeriesExpression result;
  result.begin = at = skip_space(at);
  if (auto celsius = parse_celsius(text_.substr(at, end - at))) {
    FormulaBuilder build(text_);
    build.literal(std::move(*celsius));
    result.formula = build.finish();
    at = end;
  } else {
    result.formula = parse_part(text_.substr(0, end), at, scope, wanted);
  }
  result.end = at;
  std::vector<Quantity> quantities;
  for (const std::string& name : result.formula.operands) {
    result.operands.push_back(operand_named(name));
    quantities.push_back(quantity_of(result.operands.back()));
  }
  result.quantity = infer(result.formula, quantities);
  at = skip_space(at);
  return result;
}

SeriesExpression SeriesParser::number(std::size_t& at, std::size_t end) {
  SeriesExpression result = expression(at, end);
  require_number(result);
  return result;
}

void SeriesParser::require_number(const SeriesExpression& expression) const {
  for (const Formula::Node& node : expression.formula.nodes) {
    if (node.op != Formula::Op::operand) continue;
    const Operand& operand = expression.operands[static_cast<std::size_t>(node.index)];
    const auto offset = static_cast<std::size_t>(node.offset);
    if (operand.kind == Operand::Kind::series) {
      const Measure& function = *calls_[static_cast<std::size_t>(operand.index)].measure;
      throw TextError(offset, message::series_not_number(function.signature()));
    }
    if (operand.kind != Operand::Kind::number)
      throw TextError(offset, message::changes_over_time(
                                  expression.formula.operands[static_cast<std::size_t>(node.index)]));
  }
}

void SeriesParser::require_dimension(const SeriesExpression& expression, const Quantity& wanted) const {
  const Quantity& found = expression.quantity;
  if (!found.known() || !wanted.known() || found.dimension == wanted.dimension) return;
  throw TextError(expression.begin,
                  message::wrong_dimension(to_string(wanted.dimension), wanted.dimension, found.dimension));
}

std::filesystem::path SeriesParser::file_name(std::size_t& at, std::size_t end) const {
  at = skip_space(at);
  const std::size_t first = at;
  const bool quoted = at < end && (text_[at] == '"' || text_[at] == '\'');
  const std::size_t last = quoted ? text_.find(text_[at], at + 1) : text_.find_first_of(" \t,()\"'", at);
  if (quoted && last >= end) throw TextError(first, message::expected_file());
  const std::size_t begin = quoted ? first + 1 : first;
  const std::string_view name = text_.substr(begin, std::min(last, end) - begin);
  if (name.empty()) throw TextError(first, message::expected_file());
  at = skip_space(quoted ? last + 1 : std::min(last, end));
  return (folder_ / name).lexically_normal();
}

std::optional<std::string> SeriesParser::read(std::string_view name, std::string_view text, std::size_t& at) {
  const Measure* measure = find_measure(name);
  int unnamed = 0;
  const std::size_t end = end_of_arguments(text, at, unnamed);
  if (measure == nullptr || means_language(name, unnamed)) return std::nullopt;
  constexpr int deepest = 16;
  if (depth_ >= deepest) throw TextError(at, message::nested_too_deeply());
  const std::string key = std::string(name) + std::string(text.substr(at, end - at));
  if (const auto known = known_calls_.find(key); known != known_calls_.end())
    return at = std::min(end + 1, text.size()), known->second;

  MeasureCall call;
  call.measure = measure;
  call.arguments.resize(measure->parameters.size());
  call.begin = at;
  ++depth_;
  read_arguments(call, at, end);
  --depth_;
  if (at = skip_space(at); at >= text.size())
    throw TextError(text.size(), message::expected_before(')', message::expression_ends()));
  ++at;
  check(call);
  call.quantity = quantity_of(call);
  calls_.push_back(std::move(call));
  return known_calls_[key] = "#" + std::to_string(calls_.size() - 1);
}

std::vector<std::string> SeriesParser::names() const {
  std::vector<std::string> all;
  for (const Measure& measure : measures()) all.emplace_back(measure.name);
  return all;
}

void SeriesParser::read_arguments(MeasureCall& call, std::size_t& at, std::size_t end) {
  const std::size_t first = at;
  std::size_t position = 0;
  for (at = skip_space(at); at < end; ++at) {
    at = skip_space(at);
    const std::string_view name = leading_name(text_.substr(at, end - at));
    const std::size_t behind = skip_space(at + name.size());
    const bool named = !name.empty() && behind < end && text_[behind] == '=';
    const std::size_t parameter = named ? parameter_named(call, name, at) : position++;
    if (parameter >= call.arguments.size() + 2 || (!named && parameter >= call.arguments.size()))
      throw TextError(first, message::takes(call.measure->signature(), position));
    if (named) at = behind + 1;
    read_argument(call, parameter, at, end);
    if (at < end && text_[at] != ',')
      throw TextError(at, message::unexpected(first_character(text_.substr(at))));
    if (at == end) return;
  }
}

/// The number of a parameter; those of the window stand behind the function's own.
std::size_t SeriesParser::parameter_named(const MeasureCall& call, std::string_view name,
                                          std::size_t offset) const {
  const auto& parameters = call.measure->parameters;
  const auto found = std::ranges::find(parameters, name, &MeasureParameter::name);
  const auto place = static_cast<std::size_t>(found - parameters.begin());
  std::vector<std::string> known;
  for (const MeasureParameter& parameter : parameters) known.emplace_back(parameter.name);
  bool given = place < parameters.size() && call.arguments[place];
  if (call.measure->series == nullptr && !parameters.empty()) {
    known.emplace_back(window_from);
    known.emplace_back(window_to);
    given = given || (name == window_from && call.from) || (name == window_to && call.to);
  }
  if (given) throw TextError(offset, message::argument_twice(name));
  if (place < parameters.size()) return place;
  const auto of_window = std::ranges::find(known, name);
  if (of_window == known.end())
    throw TextError(offset, message::unknown_argument(call.measure->signature(), name, known));
  return static_cast<std::size_t>(of_window - known.begin());
}

void SeriesParser::read_argument(MeasureCall& call, std::size_t parameter, std::size_t& at, std::size_t end) {
  const auto& parameters = call.measure->parameters;
  if (parameter >= parameters.size()) {
    auto& limit = parameter == parameters.size() ? call.from : call.to;
    limit = number(at, end);
    require_dimension(*limit, Quantity("s"));
    return;
  }
  auto& argument = call.arguments[parameter];
  if (argument) throw TextError(at, message::argument_twice(parameters[parameter].name));
  switch (parameters[parameter].kind) {
    case Kind::signal:
    case Kind::plain:
      argument = expression(at, end);
      break;
    case Kind::condition:
      argument = expression(at, end, Wanted::condition);
      break;
    case Kind::path:
      argument.emplace();
      argument->begin = at = skip_space(at);
      try {
        call.path = std::make_shared<const Polyline>(read_polyline(file_name(at, end)));
      } catch (const TextError&) {
        throw;
      } catch (const std::runtime_error& error) {
        throw TextError(argument->begin, message::in_file(error.what()));
      }
      argument->quantity = Quantity(call.path->unit);
      break;
    default:
      argument = number(at, end);
  }
}

void SeriesParser::check(MeasureCall& call) const {
  const auto& parameters = call.measure->parameters;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const auto& argument = call.arguments[k];
    if (!argument && parameters[k].required)
      throw TextError(call.begin, message::missing_argument(call.measure->signature(), parameters[k].name));
    if (!argument) continue;
    const Kind kind = parameters[k].kind;
    if (kind == Kind::time) require_dimension(*argument, Quantity("s"));
    if (kind == Kind::plain || kind == Kind::number) require_dimension(*argument, Quantity("1"));
    if (kind == Kind::signal || kind == Kind::level || kind == Kind::path)
      require_dimension(*argument, call.arguments[0]->quantity);
  }
}

Quantity SeriesParser::quantity_of(const MeasureCall& call) const {
  const Measure& measure = *call.measure;
  const Dimension seconds = *power(*declared_dimension("s"), measure.seconds);
  Quantity result(Quantity::Kind::known);
  result.dimension = seconds;
  if (measure.power == 0) return result;
  const Quantity& signal = call.arguments[0]->quantity;
  if (!signal.known()) {
    // Numbers alone are numbers once they were multiplied by time.
    if (signal.kind == Quantity::Kind::unknown || measure.seconds == 0) return signal;
    return result;
  }
  const auto raised = power(signal.dimension, measure.power);
  const auto whole = raised ? multiply(*raised, seconds) : std::nullopt;
  if (!whole) throw TextError(call.begin, message::exponent_too_large());
  result.dimension = *whole;
  return result;
}

}  // namespace flyball
