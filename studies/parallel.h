#pragma once

#include <cstddef>
#include <functional>

namespace flyball {

/// Calls work(0) to work(count - 1), each once, on up to `threads` threads, and returns when all are done.
/// Throws what the first call that failed has thrown; then not all need have been made.
void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& work);

}  // namespace flyball
