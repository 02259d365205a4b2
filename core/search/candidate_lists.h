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

/// Replaces a face's candidates. Those of all faces stand in the same arrays, so that one loop tests them. A list that
/// has outgrown its room goes to the end; empty places are pairs that never touch. When more than a fifth of the
/// batches are empty, the lists are moved together in the order of the faces.
void replace_list(ContactLists& lists, int face, const std::vector<Candidate>& candidates);

/// The pair that was found at `place` is released: it is tested again from the next step on.
void wake_candidate(ContactLists& lists, int place, int ball, int segment);

/// Lists one more, of no face.
void add_candidate(ContactLists& lists, const Candidate& candidate);

/// Fills the last batch up with empty places.
void fill_batch(ContactLists& lists);

/// Removes all candidates.
void clear_candidates(ContactLists& lists);

}  // namespace cellcrush
