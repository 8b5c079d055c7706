#pragma once

#include <string>
#include <string_view>

#include "blocks/linear_form.h"

/// The wording of what is said about dimensions. A unit is a form in base units alone.
namespace flyball::message {

/// "m/s", "1" for a number; with exponents such as 1/2 where units have them.
std::string unit_text(const LinearForm& unit);
/// "in m/s", "a plain number"
std::string in_unit(const LinearForm& unit);

std::string unit_contradicts(std::string_view name, const LinearForm& unit, const LinearForm& needed,
                             bool settles);
std::string override_contradicts(std::string_view name, const LinearForm& unit, const LinearForm& needed);
std::string would_settle(std::string_view name, const LinearForm& needed);
std::string would_have_to_be(std::string_view name, const LinearForm& needed);

std::string is_in_unit(std::string_view name, const LinearForm& unit);
std::string is_declared_in(std::string_view name, const LinearForm& unit);
std::string wants_number(std::string_view block, std::string_view argument);
std::string follows(std::string_view equation, std::string_view name, const LinearForm& unit);
std::string does_not_fit(std::string_view equation);

std::string hidden_in_literal(std::string_view literal, const LinearForm* unit);
std::string hidden_in_rate(std::string_view state, const LinearForm* unit);
std::string hidden_before(std::string_view equation);

}  // namespace flyball::message
