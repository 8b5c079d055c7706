#pragma once

#include <cstdint>
#include <functional>

namespace flyball {

/// Calls work(task, worker) for tasks 0, 1, … in any order, on as many threads as workers, of which each has
/// a number of its own. Rethrows the first failure; tasks that had not begun by then are left out.
void in_parallel(std::int64_t tasks, int workers, const std::function<void(std::int64_t, int)>& work);

}  // namespace flyball
