#pragma once

#include <atomic>
#include <cstddef>
#include <vector>

namespace cellcrush {

/// Steps over places in a row, each step some places behind the one before it:
///
///     step 0      place 0   1   2   3   4   5 ...
///     step 1                    0   1   2   3 ...
///     step 2                            0   1 ...
///
/// Column by column, but nobody waits for a column's end: a step takes its next place when it has done the one before,
/// and the step before is so many places ahead. No more than some steps are at work at once; the next begin where the
/// first have ended.
class Wavefront {
 public:
  /// REQUIRES: steps, places, lag, at_once >= 1.
  Wavefront(std::size_t steps, std::size_t places, std::size_t lag, std::size_t at_once);

  /// Calls visit(step, place) for what nobody has begun, until there is nothing left. Called by any number of threads,
  /// each once; what one has done is seen by those who come after it in the order above.
  template <class Visit>
  void advance(const Visit& visit) {
    for (std::size_t i = next_.fetch_add(1, std::memory_order_relaxed); i < tasks_.size();
         i = next_.fetch_add(1, std::memory_order_relaxed)) {
      const Task task = tasks_[i];
      wait_for(task);
      visit(task.step, task.place);
      done_[task.step].store(task.place + 1, std::memory_order_release);
    }
  }

 private:
  struct Task {
    std::size_t step;
    std::size_t place;
  };

  [[nodiscard]] bool is_ready(const Task& task) const;
  void wait_for(const Task& task) const;

  std::size_t places_;
  std::size_t lag_;
  std::size_t at_once_;
  std::vector<Task> tasks_;                     // none before one that it waits for: so nobody waits for ever
  std::atomic<std::size_t> next_{0};            // that nobody has begun
  std::vector<std::atomic<std::size_t>> done_;  // places of each step
};

}  // namespace cellcrush
