#pragma once

#include <cstddef>
#include <vector>

#include "cellcrush/contact_lists.h"
#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

/// A ball and a segment that may touch.
struct Candidate {
  int ball = 0;
  int segment = 0;
  double reach = 0.0;  ///< mm
};

/// Replaces the candidates of a face. Those of all faces are in the same arrays, so that one loop tests them. A list
/// that has outgrown its room moves to the end; empty entries are pairs that never touch. When more than about a fifth
/// of the batches are empty, the lists are compacted in the order of the faces.
void replace_list(ContactLists& lists, int face, const std::vector<Candidate>& candidates);

/// Notes that the pair found as candidate `index` is released: it is tested again from the next step on.
void wake_candidate(ContactLists& lists, int index, int ball, int segment);

/// Appends a candidate that belongs to no face.
void add_candidate(ContactLists& lists, const Candidate& candidate);

/// Fills the last batch with empty entries.
void fill_batch(ContactLists& lists);

/// Removes all candidates.
void clear_candidates(ContactLists& lists);

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

/// Whether the centre lines of two elements without a common node cross.
inline bool cross_each_other(const State& state, const Element& one, const Element& other) {
  const auto side_of = [&](const Element& line, int particle) {
    const Vector2& start = state.position[line.start];
    return cross(state.position[line.end] - start, state.position[particle] - start);
  };
  return !share_a_node(one, other) && side_of(one, other.start) * side_of(one, other.end) < 0.0 &&
         side_of(other, one.start) * side_of(other, one.end) < 0.0;
}

}  // namespace cellcrush
