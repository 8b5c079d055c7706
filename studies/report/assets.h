#pragma once

#include <string_view>

/// Files that are part of every page, as they were when Flyball was built.
namespace flyball::asset {

extern const std::string_view report_css;
extern const std::string_view report_js;
extern const std::string_view dygraph_css;
extern const std::string_view dygraph_js;

}  // namespace flyball::asset
