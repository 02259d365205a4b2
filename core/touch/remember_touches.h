#pragma once

#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "touch/contact_workspace.h"

namespace cellcrush {

/// Touching pairs from `first` to `end`.
struct PairRange {
  int first = 0;
  int end = 0;
};

/// The pairs of a ball. `place` is the index of one of them, or of the one after the last; otherwise the range is
/// empty.
inline PairRange pairs_of_ball(const TouchMemory& touching, int ball, int place) {
  PairRange range = {place, place};
  while (range.first > 0 && touching.ball[range.first - 1] == ball) {
    --range.first;
  }
  while (range.end < static_cast<int>(touching.count()) && touching.ball[range.end] == ball) {
    ++range.end;
  }
  return range;
}

/// Removes the released pairs from ContactLists::touching of a band, and adds those found to overlap in the faces of
/// the band or of the band before. `of_next_band` then holds the found pairs of the next band. The earlier touches go
/// to ContactWorkspace::before; Touches::known has their indices there.
///
/// Nearly all pairs touch for many steps. They are copied in long runs between the few that are added or removed.
void remember_touches(const Scene& scene, const LatticeBand& band, ContactLists& lists, ContactWorkspace& workspace,
                      std::vector<NewContact>& of_next_band);

}  // namespace cellcrush
