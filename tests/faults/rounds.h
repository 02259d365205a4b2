#pragma once

#include <cstdlib>
#include <string_view>

namespace cellcrush::testing {

/// Whether faults are made as often as a claim asks for: when CELLCRUSH_FAULT_ROUNDS is "full", as under the label
/// `long`.
inline bool is_full_round() {
  const char* value = std::getenv("CELLCRUSH_FAULT_ROUNDS");
  return value != nullptr && std::string_view(value) == "full";
}

/// How often a fault is made.
inline int rounds(int few, int full) { return is_full_round() ? full : few; }

}  // namespace cellcrush::testing
