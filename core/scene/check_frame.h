#pragma once

#include "cellcrush/scene_spec.h"
#include "scene/field_checker.h"

namespace cellcrush {

/// Checks an explicit frame: nodes that exist, beams of some length, loads with times in order.
void check_frame(const FrameLattice& frame, FieldChecker& check);

}  // namespace cellcrush
