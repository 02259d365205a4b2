#pragma once

#include <hwy/cache_control.h>

#include <thread>

#include "cellcrush/tuning.h"

namespace cellcrush {

/// Waits until the condition holds, for at most kSpinCount checks. Returns whether it holds.
template <class Condition>
bool spin_until(const Condition& holds) {
  for (int check = 0; check < kSpinCount; ++check) {
    if (holds()) {
      return true;
    }
    hwy::Pause();
  }
  return false;
}

/// Waits until the condition holds; the thread yields in between.
template <class Condition>
void wait_until(const Condition& holds) {
  while (!spin_until(holds)) {
    std::this_thread::yield();
  }
}

}  // namespace cellcrush
