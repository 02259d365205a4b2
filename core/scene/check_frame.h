#pragma once

#include "cellcrush/scene_spec.h"
#include "scene/field_checker.h"

namespace cellcrush {

/// Checks a material; `path` ends with a dot.
void check_material(const std::string& path, const MaterialSpec& material, FieldChecker& check);

/// Checks an explicit frame: nodes that exist, beams of some length, loads with times in order.
void check_frame(const FrameLattice& frame, int elements_per_wall, FieldChecker& check);

}  // namespace cellcrush
