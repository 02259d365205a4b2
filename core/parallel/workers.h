#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <thread>
#include <vector>

namespace cellcrush {

/// Threads that share the loops of a step; the caller is the first of them. A loop's items are dealt out in even, contiguous
/// parts, one a thread, always to the same threads, so that their caches keep them; only a part whose thread has not begun
/// when the caller is done with its own, because the machine is busy, is taken by the caller. What a loop computes must not
/// depend on the deal: then the bits are the same for any number of threads.
class Workers {
 public:
  /// REQUIRES: count >= 1.
  explicit Workers(int count);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  [[nodiscard]] int count() const { return static_cast<int>(threads_.size()) + 1; }

  /// Where a part of so many items starts; the part after the last starts at their end.
  [[nodiscard]] std::size_t start_of_part(std::size_t items, std::size_t part) const {
    return items * part / static_cast<std::size_t>(count());
  }

  /// Calls task(first, end) for the parts of the items 0 ... items - 1 and returns when all are done. The task must not throw.
  template <class Task>
  void share(std::size_t items, const Task& task) {
    share_parts(items, 1, [&](std::size_t, std::size_t first, std::size_t end) { task(first, end); });
  }

  /// The same of task(part, first, end), with parts 0 ... count() - 1, all of which are called, and starts of parts that are
  /// multiples of `grain`.
  template <class Task>
  void share_parts(std::size_t items, std::size_t grain, const Task& task) {
    if (threads_.empty()) {
      task(std::size_t{0}, std::size_t{0}, items);
      return;
    }
    run({&task, items, grain, [](const void* shared, std::size_t part, std::size_t first, std::size_t end) {
           (*static_cast<const Task*>(shared))(part, first, end);
         }});
  }

 private:
  struct Job {
    const void* task = nullptr;
    std::size_t items = 0;
    std::size_t grain = 1;
    void (*call)(const void* task, std::size_t part, std::size_t first, std::size_t end) = nullptr;
  };

  void run(const Job& job);
  void do_part(std::size_t part);
  bool claim(std::size_t part, std::uint64_t round);
  void work(std::size_t part);

  Job job_;
  alignas(64) std::atomic<std::uint64_t> round_{0};  // of the newest job
  alignas(64) std::atomic<int> pending_{0};          // parts that are not done
  std::vector<std::atomic<std::uint64_t>> claimed_;  // of each part, the newest round in which somebody took it
  std::atomic<bool> stopped_{false};
  std::vector<std::thread> threads_;
};

}  // namespace cellcrush
