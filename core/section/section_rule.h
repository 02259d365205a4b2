#pragma once

#include "cellcrush/scene.h"

namespace cellcrush {

/// Gauss points along the element, Lobatto points through its depth. REQUIRES: axial_points >= 1, depth_points >= 2.
SectionRule make_section_rule(int axial_points, int depth_points);

}  // namespace cellcrush
