#pragma once

#include <cstddef>
#include <limits>

namespace cellcrush::store {

/// How much of a long list to read at once: limits of entries and bytes. Default no limit.
class PageRoom {
 public:
  PageRoom() = default;
  PageRoom(int entries, std::size_t bytes) : entries_(entries), bytes_(bytes) {}

  /// Adds an entry of this size; false if there is no room. There is always room for the first.
  bool take(std::size_t bytes) {
    if (!is_empty_ && (entries_ == 0 || bytes > bytes_)) return false;
    is_empty_ = false;
    if (entries_ > 0) --entries_;
    bytes_ -= bytes < bytes_ ? bytes : bytes_;
    return true;
  }

 private:
  int entries_ = std::numeric_limits<int>::max();
  std::size_t bytes_ = std::numeric_limits<std::size_t>::max();
  bool is_empty_ = true;
};

}  // namespace cellcrush::store
