#pragma once
#include "blocks/interpolate.h"

namespace flyball {

struct LookupTable2D : Block {
  static constexpr auto summary = "A function of its two inputs, given by a table.";
  static constexpr std::array aliases{"Modelica.Blocks.Tables.CombiTable2Ds", "LOOKUP2D", "INTRP2BLK_f"};
  TableAxis::Method method = static_cast<TableAxis::Method>(option(
      "method", "linear", TableAxis::method_names(),
      "between breakpoints: linear in each input, the nearest value, or that of the breakpoints below"));
  bool clips = option("extrapolation", "linear", {"linear", "clip"},
                      "beyond the ends of `linear`: as in the last interval, or the value at the end") == 1;
  Coefficients rows =
      coefficients("breakpoints1", {-1.0, 0.0, 1.0}, "any", "value of u1, rising", Entries::increasing);
  Coefficients columns =
      coefficients("breakpoints2", {-1.0, 0.0, 1.0}, "any", "value of u2, rising", Entries::increasing);
  Coefficients table =
      matrix("table", {{1.0, 0.0, -1.0}, {0.0, 0.0, 0.0}, {-1.0, 0.0, 1.0}},
             "value of y: a row for each of breakpoints1, in it one for each of breakpoints2", Entries::all);
  Input u1 = input("u1", "any", "signal that chooses between rows");
  Input u2 = input("u2", "any", "signal that chooses between columns");
  Output y = output("y", "any", "value of the table at the signals");
  TableAxis axis1{rows, method, clips,
                  relations_each("row_passed", TableAxis::edges(rows.columns(), method, clips),
                                 "u1 is above this kink or jump of the table")};
  TableAxis axis2{columns, method, clips,
                  relations_each("column_passed", TableAxis::edges(columns.columns(), method, clips),
                                 "u2 is above this kink or jump of the table")};

  explicit LookupTable2D(Settings* settings) : Block(settings) {
    if (rows.columns() < 2) refuse("breakpoints1", "expected at least two numbers");
    if (columns.columns() < 2) refuse("breakpoints2", "expected at least two numbers");
    if (table.rows() != rows.columns() || table.columns() != columns.columns()) {
      const auto size = [](int r, int c) { return std::to_string(r) + " by " + std::to_string(c); };
      refuse("table", "expected " + size(rows.columns(), columns.columns()) + " numbers, found " +
                          size(table.rows(), table.columns()));
    }
    if (given("extrapolation") && !clips && method != TableAxis::Method::linear) {
      refuse("extrapolation", "expected \"clip\": only the method \"linear\" goes on beyond the ends");
    }
  }

  void relations(auto& v) const {
    axis1.relations(v, u1);
    axis2.relations(v, u2);
  }
  void outputs(auto& v) const {
    v[y] = axis1.interpolate(v, u1, [&](int r) {
      return axis2.interpolate(v, u2,
                               [&](int c) { return v[table.entries()[r * table.columns() + c].param]; });
    });
  }
};

}  // namespace flyball
