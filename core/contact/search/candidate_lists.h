#pragma once

#include <vector>

#include "cellcrush/contact_lists.h"

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

}  // namespace cellcrush
