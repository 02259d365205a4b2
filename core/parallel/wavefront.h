#pragma once

#include <atomic>
#include <cstddef>
#include <vector>

namespace cellcrush {

/// Steps over items in a row; each step is some items (`lag`) behind the step before:
///
///     step 0      item 0   1   2   3   4   5 ...
///     step 1                   0   1   2   3 ...
///     step 2                           0   1 ...
///
/// Tasks are begun column by column, but no thread waits for the end of a column. A step begins its next item when it
/// has done the item before and the step before is `lag` items ahead. At most `at_once` steps are in progress; later
/// steps begin when the first ones have ended.
class Wavefront {
 public:
  /// REQUIRES: steps, items, lag, at_once >= 1.
  Wavefront(std::size_t steps, std::size_t items, std::size_t lag, std::size_t at_once);

  /// Calls visit(step, index of the item) for tasks that no thread has begun, until none are left. Any number of
  /// threads may call it, each once. Results of a task are visible to the tasks that follow it in the order above.
  template <class Visit>
  void advance(const Visit& visit) {
    for (std::size_t i = next_.fetch_add(1, std::memory_order_relaxed); i < tasks_.size();
         i = next_.fetch_add(1, std::memory_order_relaxed)) {
      const auto [step, index] = tasks_[i];
      wait_for(tasks_[i]);
      visit(step, index);
      done_[step].store(index + 1, std::memory_order_release);
    }
  }

 private:
  struct Task {
    std::size_t step;
    std::size_t index;
  };

  /// Waits until all tasks are done that a task follows.
  void wait_for(const Task& task) const;

  std::size_t items_;
  std::size_t lag_;
  std::size_t at_once_;
  std::vector<Task> tasks_;                     // no task precedes one that it waits for, so no thread waits forever
  std::atomic<std::size_t> next_{0};            // next task that no thread has begun
  std::vector<std::atomic<std::size_t>> done_;  // number of items done, of each step
};

}  // namespace cellcrush
