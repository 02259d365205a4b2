#pragma once

#include <hwy/cache_control.h>

#include <thread>

namespace cellcrush {

/// Looks at a flag before a thread gives way to others: some hundred microseconds, longer than the gaps between a step's loops.
inline constexpr int kLooks = 4000;

/// Returns when the condition holds, after at most kLooks looks; whether it does.
template <class Condition>
bool spin_until(const Condition& holds) {
  for (int look = 0; look < kLooks; ++look) {
    if (holds()) {
      return true;
    }
    hwy::Pause();
  }
  return false;
}

/// Returns when the condition holds; others go before in between.
template <class Condition>
void wait_until(const Condition& holds) {
  while (!spin_until(holds)) {
    std::this_thread::yield();
  }
}

}  // namespace cellcrush
