#include "solvers/parallel.h"

#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace flyball {

void in_parallel(std::int64_t tasks, int workers, const std::function<void(std::int64_t, int)>& work) {
  std::atomic<std::int64_t> next = 0;
  std::exception_ptr failure;
  std::mutex guard;
  const auto serve = [&](int worker) {
    try {
      for (std::int64_t task = next++; task < tasks; task = next++) work(task, worker);
    } catch (...) {
      const std::lock_guard lock(guard);
      if (!failure) failure = std::current_exception();
      next = tasks;
    }
  };
  std::vector<std::jthread> threads;
  for (int worker = 1; worker < workers; ++worker) threads.emplace_back(serve, worker);
  serve(0);
  threads.clear();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace flyball
