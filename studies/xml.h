#pragma once

#include <string>
#include <string_view>

namespace flyball {

/// UTF-8: bytes that are none become U+FFFD.
std::string valid_text(std::string_view text);

/// Text as XML and HTML take it between tags. What they cannot hold becomes U+FFFD.
std::string xml_text(std::string_view text);
/// The same in double quotes: the ends of lines are kept.
std::string xml_attribute(std::string_view text);

}  // namespace flyball
