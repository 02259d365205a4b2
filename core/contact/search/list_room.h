#pragma once

#include <cstddef>

namespace cellcrush {

/// Makes room for so many entries in a list that grows over a crush: where it must move, for an eighth more. A vector
/// by itself would make room for twice as many, and what it leaves behind is too small to be used again.
template <class List>
void make_room(List& list, std::size_t size) {
  if (size > list.capacity()) {
    list.reserve(size + size / 8);
  }
}

/// Resizes such a list, with copies of `fill` at the end if it is given.
template <class List, class... Fill>
void resize_with_room(List& list, std::size_t size, const Fill&... fill) {
  make_room(list, size);
  list.resize(size, fill...);
}

}  // namespace cellcrush
