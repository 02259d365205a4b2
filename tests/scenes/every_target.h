#pragma once

#include <gtest/gtest.h>

#include <string>

#include "cellcrush/simd.h"

namespace cellcrush::scenes {

/// Calls visit() with every kernel that the processor has, one after the other.
template <class Visit>
void for_every_target(Visit&& visit) {
  for (const std::string& target : simd_targets()) {
    SCOPED_TRACE(target);
    ASSERT_TRUE(use_simd_target(target));
    visit();
  }
  ASSERT_TRUE(use_simd_target(""));
}

}  // namespace cellcrush::scenes
