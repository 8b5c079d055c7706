#pragma once
#include "blocks/interpolate.h"

namespace flyball {

struct LookupTable1D : Block {
  static constexpr auto summary = "A function of its input, given by a table.";
  static constexpr std::array aliases{"Modelica.Blocks.Tables.CombiTable1Ds", "LOOKUP_f", "LOOKUP_c",
                                      "INTRPLBLK_f"};
  TableAxis::Method method = static_cast<TableAxis::Method>(
      option("method", "linear", TableAxis::method_names(),
             "between breakpoints: a line, the nearest value, or the value of the breakpoint below"));
  bool clips =
      option("extrapolation", "linear", {"linear", "clip"},
             "beyond the ends of `linear`: the line of the last interval, or the value at the end") == 1;
  Coefficients breakpoints =
      coefficients("breakpoints", {-1.0, 0.0, 1.0}, "any", "value of u, rising", Entries::increasing);
  Coefficients table =
      coefficients("table", {-1.0, 0.0, 1.0}, "any", "value of y at each breakpoint", Entries::all);
  Input u = input("u", "any", "signal");
  Output y = output("y", "any", "value of the table at the signal");
  TableAxis axis{breakpoints, method, clips,
                 relations_each("passed", TableAxis::edges(breakpoints.columns(), method, clips),
                                "the signal is above this kink or jump of the table")};

  explicit LookupTable1D(Settings* settings) : Block(settings) {
    if (breakpoints.columns() < 2) refuse("breakpoints", "expected at least two numbers");
    if (table.columns() != breakpoints.columns()) {
      refuse("table", "expected " + std::to_string(breakpoints.columns()) +
                          " numbers, one for each breakpoint, found " + std::to_string(table.columns()));
    }
    if (given("extrapolation") && !clips && method != TableAxis::Method::linear) {
      refuse("extrapolation", "expected \"clip\": only the method \"linear\" goes on beyond the ends");
    }
  }

  void relations(auto& v) const { axis.relations(v, u); }
  void outputs(auto& v) const {
    v[y] = axis.interpolate(v, u, [&](int k) { return v[table.entries()[k].param]; });
  }
};

}  // namespace flyball
