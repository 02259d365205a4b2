#pragma once

#include <optional>

#include "cellcrush/scene_spec.h"
#include "lattice/layout.h"

namespace cellcrush {

class FieldChecker;

/// Whether the sides of a spec repeat (loading.sides PERIODIC) along an axis, 0: x, 1: y.
bool repeats_along(const SceneSpec& spec, int axis);

/// That axis, across the crush; nothing if they do not repeat.
std::optional<int> repeated_axis_of(const SceneSpec& spec);

/// Length after which such sides repeat, across the crush, mm: that of the lattice, or as given for a network. 0 if
/// they do not repeat. REQUIRES: a checked spec.
double period_of(const SceneSpec& spec);

/// What prevents that a layout is closed; -1: nothing does.
struct Unclosed {
  int image_wall = -1;  ///< a wall that is the image of `wall`, both of which stand in the layout
  int wall = -1;
  int wide_joint = -1;  ///< a joint that has images on either side
};

/// Pairs the joints at the low side with their images, `length` mm further on along an axis, to a millionth of it
/// (Layout::images). Walls that are images of others are removed, with the joints that they leave: each wall stands
/// once. Returns what keeps a layout from that, -1 where nothing does.
Unclosed close_period(int axis, double length, Layout& layout);

/// Puts the images where the joints at the low side say, which imperfections have moved.
void align_images(int axis, double length, Layout& layout);

/// Checks the sides of a spec that repeat, and that nothing else holds or cuts them.
/// REQUIRES: a lattice without problems.
void check_period(const SceneSpec& spec, FieldChecker& check);

}  // namespace cellcrush
