#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "blocks/dimension.h"
#include "blocks/specification.h"
#include "models/language/toml.h"

/// The wording of all that can be wrong with a model, so that it can be read and improved in one place.
namespace flyball::message {

using Names = std::vector<std::string>;
using Text = std::string_view;

// The file as a whole.
std::string unreadable(Text reason);
std::string not_utf8(unsigned char byte);
std::string line_too_long(std::size_t limit);
std::string nested_too_deeply(int limit);
std::string syntax(Text reason);
std::string stands_twice(Text key);
std::string first_stands_here(Text key);
std::string section_stands_twice(Text reason);
std::string not_a_finite_literal(Text literal);
std::string wrong_type(Text expected, const TomlValue& found);
std::string unknown_key(Text key, Text owner, const Names& known);
std::string missing_key(Text key, Text owner);
std::string missing_section(Text name);
std::string missing_version(int version);
std::string unknown_version(std::int64_t found, int known);
std::string not_a_name(Text name);
std::string in_override(Text name, Text message);
std::string no_such_entry(Text block, Text setting);

// Subsystems.
std::string used_here(Text name);
std::string unreadable_file(Text file, Text reason);
std::string file_without_ports();
std::string cyclic_subsystems(Text chain);
std::string hierarchy_too_deep(int limit);
std::string too_many_blocks(long limit);
std::string name_of_block_type(Text name);
std::string block_and_port(Text name);
std::string unused_subsystem(Text name);
std::string subsystem_keeps_type();
std::string no_parts(Text block);
std::string missing_parameter(Text block, Text type, Text parameter);
std::string element_count(std::int64_t found, int limit);
std::string no_elements();
std::string unit_count(std::size_t elements, std::size_t units);
std::string port_direction(Text port, bool is_input);
std::string output_not_driven(Text port);
std::string input_of_model_open(Text port);
std::string ports_in_a_circle(Text port);

// Units.
std::string unknown_unit(Text name);
std::string expected_in_unit(Text expected);
std::string celsius_in_compound();
std::string exponent_too_large();
std::string unit_not_si(Text unit, const Dimension& dimension);
std::string wrong_dimension(Text unit, const Dimension& declared, const Dimension& found);
std::string hertz_for_radians(Text unit);
std::string unequal_dimensions(const Dimension& a, const Dimension& b);
std::string expected_plain_number(const Dimension& found);

// Expressions.
std::string unexpected(Text found);
std::string expression_ends();
std::string expected_before(char expected, Text found);
std::string unknown_name(Text name, const Names& known);
std::string unknown_function(Text name, const Names& known);
std::string argument_count(Text function, int expected, int found);
std::string parameter_after_number(Text number, Text name);
std::string number_out_of_reach();
std::string no_equality();
std::string chained_comparison();
std::string expected_number();
std::string expected_condition();
std::string expression_too_deep();
std::string expression_too_long();
std::string not_finite(double value);
std::string not_exact(Text expression);
std::string not_whole(double value);

// Parameters.
std::string unknown_parameter(Text name, const Names& known);
std::string cyclic_parameters(const Names& chain);
std::string out_of_range(Text name, double value, const Range& range, Text unit);
std::string not_increasing(Text name, double value, double before);
std::string range_of_two(std::size_t found);
std::string range_reversed(double lower, double upper);
std::string range_uses_parameters();
std::string declared_here(Text name);

// Blocks.
std::string unknown_type(Text name, const Names& known);
std::string unknown_setting(Text name, Text type, const Names& known);
std::string setting_of_other_structure(Text name, Text type);
std::string setting_refused(Text setting, Text reason);
std::string block_refused(Text block, Text reason);
std::string empty_list();
std::string ragged_table(int expected, std::size_t found);

// Wires and logged signals.
std::string expected_block();
std::string unknown_block(Text name, const Names& known);
std::string unknown_port(Text block, Text port, bool is_input, const Names& known);
std::string wrong_direction(Text block, Text port, bool wants_input, const Names& candidates);
std::string no_port(Text block, Text type, bool is_input);
std::string several_ports(Text block, Text type, bool is_input, const Names& ports);
std::string unknown_element(Text port, Text element, const Names& known);
std::string wire_without_arrow();
std::string wire_too_long(std::size_t limit);
std::string fan_out_inside_chain();
std::string object_and_number(Text from, Text to, bool to_number);
std::string different_objects(Text from, Text to);
std::string different_widths(Text from, int from_width, Text to, int to_width);
std::string different_units(Text from, Text from_unit, Text to, Text to_unit);
std::string block_of_type(Text block, Text type);
std::string driven_twice(Text input);
std::string first_wire_here();
std::string not_connected(Text input, Text unit, Text doc);
std::string nothing_to_log(Text block);
std::string logged_object(Text port);

// Files of values.
std::string in_data_file(Text problem);
std::string file_too_large(std::size_t limit);
std::string control_character(char found);
std::string csv_empty();
std::string csv_without_rows();
std::string csv_row_width(int expected, int found);
std::string csv_quote_inside();
std::string csv_quote_open();
std::string csv_after_quote();
std::string csv_column_without_name();
std::string csv_column_twice(Text name);
std::string csv_not_finite(Text number);
std::string csv_not_a_number(Text field);
std::string csv_time_alone();
std::string csv_unknown_column(Text name, const Names& known);
std::string csv_time_falls(double before, double after);

// Simulation.
std::string unknown_method(Text name, const Names& known);
std::string discrete_with_states(const Names& states);
std::string not_one_number(Text port);
std::string unknown_choice(Text key, Text name, const Names& choices);

}  // namespace flyball::message
