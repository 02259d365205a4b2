#pragma once

#include <string>

#include "cellcrush/scene_spec.h"

namespace cellcrush::translate {

/// That a regular lattice between plates is a small specimen: that it has fewer columns or rows of cells than the
/// largest specimen of its kind whose mesh errors were measured, a preset. With the largest measured differences of a
/// smaller specimen from that preset (server/presets/small_specimens.csv), as sentences. Empty for any other case.
std::string describe_small_specimen(const SceneSpec& spec);

}  // namespace cellcrush::translate
