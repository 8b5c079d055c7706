#pragma once
#include <algorithm>

#include "blocks/block.h"

namespace flyball {

struct FromFile : Block {
  static constexpr auto summary =
      "A column of a file of comma-separated values, over its first column, time.";
  static constexpr std::array aliases{"Modelica.Blocks.Sources.CombiTimeTable", "RFILE_f"};
  static constexpr bool lockstep = false;  // each run is at a row of its own
  std::shared_ptr<const TimeSeries> data = time_series("file", "column");
  // In the order of `choices`.
  enum class Outside { hold, linear, zero };
  bool interpolates = option("interpolation", "linear", {"linear", "hold"}, "between two rows") == 0;
  Outside before = outside("before", "before the first row: its value, its line, or 0");
  Outside after = outside("after", "after the last row: its value, its line, or 0");
  Output y = output("y", data->unit, "the value");
  Held row = held("row", rows_until(0.0), "1", "number of rows that have passed");
  Held start = held("start", piece(rows_until(0.0)).start, "s", "time at which this piece began");
  Held value = held("value", piece(rows_until(0.0)).value, data->unit, "value at that time");
  Held slope = held("slope", piece(rows_until(0.0)).slope, "any", "change per second in this piece");
  Held due = held("due", time_of(rows_until(0.0)), "s", "time of the next row");
  Held waits = held("waits", rows_until(0.0) < rows() ? 1.0 : 0.0, "1", "1 until the last row has passed");
  Alarm kink = alarm("kink", "the next row");

  void schedule(auto& v) const { v[kink] = select(v.on(waits), v[due], never); }
  void on_time(auto& v) const {
    const auto after_row = [&](auto&& entry) {
      return look_up(v[row], rows(), [&](int k) { return v.number(entry(rows_until(data->times[k]))); });
    };
    v.next(row) = after_row([](int passed) { return passed; });
    v.next(start) = after_row([&](int passed) { return piece(passed).start; });
    v.next(value) = after_row([&](int passed) { return piece(passed).value; });
    v.next(slope) = after_row([&](int passed) { return piece(passed).slope; });
    v.next(due) = after_row([&](int passed) { return time_of(passed); });
    v.next(waits) = after_row([&](int passed) { return passed < rows() ? 1.0 : 0.0; });
  }
  void outputs(auto& v) const { v[y] = v[value] + v[slope] * (v.time() - v[start]); }

 private:
  struct Piece {
    double start = 0.0, value = 0.0, slope = 0.0;
  };

  Outside outside(const std::string& key, const std::string& doc) {
    return static_cast<Outside>(option(key, "hold", {"hold", "linear", "zero"}, doc));
  }
  int rows() const { return static_cast<int>(data->times.size()); }
  /// The number of rows whose time is not after t.
  int rows_until(double t) const {
    return static_cast<int>(std::ranges::upper_bound(data->times, t) - data->times.begin());
  }
  /// Of row k, counted from 0; of the last one past the end.
  double time_of(int k) const { return data->times[std::min(k, rows() - 1)]; }
  double slope_between(int a, int b) const {
    const double width = data->times[b] - data->times[a];
    return width > 0.0 ? (data->values[b] - data->values[a]) / width : 0.0;
  }
  /// What holds after so many rows.
  Piece piece(int passed) const {
    const bool first = passed == 0, last = passed == rows();
    const Outside rule = first ? before : last ? after : interpolates ? Outside::linear : Outside::hold;
    if ((first || last) && rule == Outside::zero) return {};
    const int from = first ? 0 : passed - 1;
    Piece result{data->times[from], data->values[from], 0.0};
    if (rule != Outside::linear || rows() < 2) return result;
    const int left = std::clamp(passed - 1, 0, rows() - 2);
    result.slope = slope_between(left, left + 1);
    return result;
  }
};

}  // namespace flyball
