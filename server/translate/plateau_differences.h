#pragma once

#include <string>

#include "cellcrush/scene_spec.h"

namespace cellcrush::translate {

/// That a regular lattice between plates is a small specimen: that it has fewer columns or rows of cells than the
/// largest specimen of its kind whose mesh errors were measured, a preset. With the largest measured differences of a
/// smaller specimen from that preset (server/presets/small_specimens.csv), as sentences. Empty for any other case.
std::string describe_small_specimen(const SceneSpec& spec);

/// The largest measured differences of the default mesh of such a lattice between plates from one twice as fine
/// (server/presets/default_meshes.csv), of the relative density that is nearest to the given one, as a sentence. Empty
/// for a lattice that was not measured, and for elements other than the default ones.
std::string describe_default_mesh(const SceneSpec& spec, double relative_density);

}  // namespace cellcrush::translate
