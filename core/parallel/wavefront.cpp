#include "parallel/wavefront.h"

#include <algorithm>

#include "parallel/spin.h"

namespace cellcrush {

Wavefront::Wavefront(std::size_t steps, std::size_t items, std::size_t lag, std::size_t at_once)
    : items_(items), lag_(lag), at_once_(at_once), done_(steps) {
  std::vector<std::size_t> first(steps, 0);  // the column in which each step begins
  for (std::size_t step = 1; step < steps; ++step) {
    const std::size_t room = step >= at_once ? first[step - at_once] + items : 0;
    first[step] = std::max(first[step - 1] + lag, room);
  }
  tasks_.reserve(steps * items);
  for (std::size_t column = 0; column < first.back() + items; ++column) {
    for (std::size_t step = 0; step < steps && first[step] <= column; ++step) {
      if (column - first[step] < items) {
        tasks_.push_back({step, column - first[step]});
      }
    }
  }
}

void Wavefront::wait_for(const Task& task) const {
  const auto has_done = [&](std::size_t step, std::size_t items) {
    return done_[step].load(std::memory_order_acquire) >= std::min(items, items_);
  };
  wait_until([&] {
    return has_done(task.step, task.index) && (task.step == 0 || has_done(task.step - 1, task.index + lag_)) &&
           (task.step < at_once_ || has_done(task.step - at_once_, items_));
  });
}

}  // namespace cellcrush
