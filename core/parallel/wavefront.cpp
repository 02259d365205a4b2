#include "parallel/wavefront.h"

#include <algorithm>

#include "parallel/spin.h"

namespace cellcrush {
namespace {

/// The column in which each step begins.
std::vector<std::size_t> first_columns(std::size_t steps, std::size_t places, std::size_t lag, std::size_t at_once) {
  std::vector<std::size_t> columns(steps, 0);
  for (std::size_t step = 1; step < steps; ++step) {
    const std::size_t room = step >= at_once ? columns[step - at_once] + places : 0;
    columns[step] = std::max(columns[step - 1] + lag, room);
  }
  return columns;
}

}  // namespace

Wavefront::Wavefront(std::size_t steps, std::size_t places, std::size_t lag, std::size_t at_once)
    : places_(places), lag_(lag), at_once_(at_once), done_(steps) {
  const std::vector<std::size_t> first = first_columns(steps, places, lag, at_once);
  tasks_.reserve(steps * places);
  for (std::size_t column = 0; column < first.back() + places; ++column) {
    for (std::size_t step = 0; step < steps && first[step] <= column; ++step) {
      if (column - first[step] < places) {
        tasks_.push_back({step, column - first[step]});
      }
    }
  }
}

bool Wavefront::is_ready(const Task& task) const {
  const auto has_done = [&](std::size_t step, std::size_t places) {
    return done_[step].load(std::memory_order_acquire) >= std::min(places, places_);
  };
  return has_done(task.step, task.place) && (task.step == 0 || has_done(task.step - 1, task.place + lag_)) &&
         (task.step < at_once_ || has_done(task.step - at_once_, places_));
}

void Wavefront::wait_for(const Task& task) const {
  wait_until([&] { return is_ready(task); });
}

}  // namespace cellcrush
