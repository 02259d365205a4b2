#pragma once

#include "cellcrush/problem.h"
#include "cellcrush/scene_spec.h"

namespace cellcrush {

/// What a sound spec can be run with and hardly be meant: values in another unit, walls too thick for beams, speeds
/// near that of an elastic wave in the walls. Sentences as those of a Problem; nothing is kept from running. REQUIRES:
/// check_spec finds no problem.
Problems find_implausible(const SceneSpec& spec);

}  // namespace cellcrush
