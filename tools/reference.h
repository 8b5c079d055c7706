#pragma once

#include <string>

#include "blocks/registry.h"

namespace flyball {

/// The reference page of a block in Markdown, from its declarations and what was derived from its equations:
/// as they are with default structure; what other structure adds is marked.
std::string reference_page(const BlockType& type);

/// The contents of the reference, with links to the pages NAME.md.
std::string reference_index();

/// All blocks by family, with their summaries, for a terminal.
std::string block_list();

/// "any", "> 0", "[0, 1)"
std::string to_string(const Range& range);

}  // namespace flyball
