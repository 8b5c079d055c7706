#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "blocks/formula.h"
#include "blocks/rational.h"
#include "blocks/time_series.h"

namespace flyball {

/// The rows and columns of a list or table of coefficients; `zero[r * columns + c]` marks entries that are
/// the literal 0, which count as absent (structure), so that they make no false feedthrough.
struct Shape {
  int rows = 0;
  int columns = 0;
  std::vector<bool> zero;
};

/// A table of numbers; its rows may differ in length.
using NumberRows = std::vector<std::vector<double>>;

/// What a block's constructor may ask of the text that describes it. The model language implements it.
/// Each getter gives nothing when the key is not given, or is wrong (it has then been reported).
class Settings {
 public:
  virtual ~Settings() = default;
  virtual bool given(std::string_view key) const = 0;
  virtual std::optional<std::string> text(std::string_view key) = 0;
  virtual std::optional<long> integer(std::string_view key) = 0;
  virtual std::optional<std::vector<long>> integers(std::string_view key) = 0;
  virtual std::optional<bool> flag(std::string_view key) = 0;
  /// A number, exactly, in SI; an expression makes its parameters structural.
  virtual std::optional<Rational> exact(std::string_view key) = 0;
  virtual std::optional<std::vector<std::string>> list(std::string_view key) = 0;
  /// A list has one row; a list of lists has a row each.
  virtual std::optional<Shape> shape(std::string_view key) = 0;
  /// NumberRows of lengths, in m: a list of lists; a list is one row, a length a row of one. Expressions make
  /// their parameters structural.
  virtual std::optional<NumberRows> lengths(std::string_view key) = 0;
  /// Columns of a file; see Block::columns.
  virtual std::optional<NumberRows> columns(std::string_view file, const std::vector<std::string>& names,
                                            const std::string& unit) = 0;
  /// A column of a file; see Block::time_series.
  virtual std::shared_ptr<const TimeSeries> time_series(std::string_view file, std::string_view column) = 0;
  /// An expression; names that are not in `inputs` are parameters of the model.
  virtual std::shared_ptr<const Formula> formula(std::string_view key,
                                                 const std::vector<std::string>& inputs) = 0;
  /// Reports what is wrong with the value of `key` (or with the block, when the key is not given).
  virtual void refuse(std::string_view key, std::string message) = 0;
};

}  // namespace flyball
