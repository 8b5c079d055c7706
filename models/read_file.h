#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace flyball {

/// A model file larger than this is not read: what stands for one may be a device without an end.
inline constexpr std::size_t largest_model = 500'000'000;

/// All bytes of a file. Nothing when it cannot be read or has more than `most` bytes; errno then says why.
std::optional<std::string> read_file_content(const std::string& file, std::size_t most = largest_model);

}  // namespace flyball
