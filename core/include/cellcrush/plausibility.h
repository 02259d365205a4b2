#pragma once

#include "cellcrush/problem.h"
#include "cellcrush/scene_spec.h"

namespace cellcrush {

/// Reports values of a valid spec that are probably mistakes: another unit, walls too thick for beams, a speed near
/// that of an elastic wave in the walls. Worded like a Problem, but none of them prevents the run. REQUIRES: check_spec
/// finds no problem.
Problems find_implausible(const SceneSpec& spec);

}  // namespace cellcrush
