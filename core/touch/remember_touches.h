#pragma once

#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "touch/contact_workspace.h"

namespace cellcrush {

/// Pairs from `first` to `end` of those that touch.
struct PairRange {
  int first = 0;
  int end = 0;
};

/// The pairs of a ball, of which `place` is one, or the one behind the last; none if it is neither.
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

/// Removes the released pairs from ContactLists::touching of a band, and adds those found to overlap in the band's
/// faces or in those of the band before; `of_next_band` then holds those of the next. What touched before goes to
/// ContactWorkspace::before; Touches::known holds the index there.
///
/// Nearly all pairs touch for many steps: they are copied in long runs between the few that come and go.
void remember_touches(const Scene& scene, const LatticeBand& band, ContactLists& lists, ContactWorkspace& workspace,
                      std::vector<NewContact>& of_next_band);

}  // namespace cellcrush
