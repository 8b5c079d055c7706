#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <vector>

namespace flyball {

/// Hands what several threads finish to one receiver, one call at a time. A thread that finds the receiver
/// busy leaves its item to the thread that is there and goes on; it only waits where too many items lie
/// about.
template <class Item>
class Delivery {
 public:
  using Receiver = std::function<void(std::vector<Item>&)>;

  explicit Delivery(Receiver receiver) : receiver_(std::move(receiver)) {}

  /// Throws what the receiver throws, in the thread that called it; the items of that call are lost.
  void put(Item item) {
    std::unique_lock lock(guard_);
    room_.wait(lock, [&] { return !busy_ || waiting_.size() < most_waiting; });
    waiting_.push_back(std::move(item));
    if (busy_) return;
    const Busy busy(*this);
    while (!waiting_.empty()) {
      const Unlocked unlocked(lock, taken_, waiting_);
      room_.notify_all();
      receiver_(taken_);
    }
  }

 private:
  static constexpr std::size_t most_waiting = 64;

  struct Busy {
    explicit Busy(Delivery& of) : delivery(of) { delivery.busy_ = true; }
    ~Busy() {
      delivery.busy_ = false;
      delivery.room_.notify_all();
    }
    Busy(const Busy&) = delete;
    Busy& operator=(const Busy&) = delete;
    Delivery& delivery;
  };

  /// Takes all that is waiting, and gives the lock away while it lives.
  struct Unlocked {
    Unlocked(std::unique_lock<std::mutex>& of, std::vector<Item>& taken, std::vector<Item>& waiting)
        : lock(of) {
      taken.clear();
      taken.swap(waiting);
      lock.unlock();
    }
    ~Unlocked() { lock.lock(); }
    Unlocked(const Unlocked&) = delete;
    Unlocked& operator=(const Unlocked&) = delete;
    std::unique_lock<std::mutex>& lock;
  };

  Receiver receiver_;
  std::mutex guard_;
  std::condition_variable room_;
  std::vector<Item> waiting_, taken_;
  bool busy_ = false;
};

}  // namespace flyball
