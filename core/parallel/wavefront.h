#pragma once

#include <atomic>
#include <cstddef>
#include <vector>

namespace cellcrush {

/// Steps over places in a row; each step is some places (`lag`) behind the step before:
///
///     step 0      place 0   1   2   3   4   5 ...
///     step 1                    0   1   2   3 ...
///     step 2                            0   1 ...
///
/// Tasks are begun column by column, but no thread waits for the end of a column. A step begins its next place when it
/// has done the place before and the step before is `lag` places ahead. At most `at_once` steps are in progress; later
/// steps begin when the first ones have ended.
class Wavefront {
 public:
  /// REQUIRES: steps, places, lag, at_once >= 1.
  Wavefront(std::size_t steps, std::size_t places, std::size_t lag, std::size_t at_once);

  /// Calls visit(step, place) for tasks that no thread has begun, until none are left. Any number of threads may call
  /// it, each once. Results of a task are visible to the tasks that follow it in the order above.
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
  std::vector<Task> tasks_;                     // no task precedes one that it waits for, so no thread waits forever
  std::atomic<std::size_t> next_{0};            // next task that no thread has begun
  std::vector<std::atomic<std::size_t>> done_;  // number of places done, of each step
};

}  // namespace cellcrush
