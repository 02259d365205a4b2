#pragma once

#include <vector>

#include "cellcrush/state.h"

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
void replace_list(State& state, int face, const std::vector<Candidate>& candidates);

/// Fills the last batch up with empty places.
void fill_batch(State& state);

/// Lets go of all candidates.
void clear_candidates(State& state);

}  // namespace cellcrush
