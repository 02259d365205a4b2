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

/// Puts a face's candidates in place of those it had. All faces' stand in the same arrays, so that they are tested in one
/// loop: a list that has outgrown its room goes to the end, and empty places are pairs that never touch. When a fifth of
/// the batches and more are empty, the lists are moved together in the order of the faces.
void replace_list(ContactLists& lists, int face, const std::vector<Candidate>& candidates);

/// A pair that was found at `place` has parted: it is tested again from the next step on.
void wake_candidate(ContactLists& lists, int place, int ball, int segment);

/// Lists one more, of no face.
void add_candidate(ContactLists& lists, const Candidate& candidate);

/// Fills the last batch up with empty places.
void fill_batch(ContactLists& lists);

/// Lets go of all candidates.
void clear_candidates(ContactLists& lists);

}  // namespace cellcrush
