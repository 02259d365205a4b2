#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/scene_spec.h"

namespace cellcrush {

/// Sections along an element and points through its depth.
///
/// Displacement-based (the paper): Gauss points along, where Eq. 27 has the curvature.
/// Force-based: both joints are sections, so that no moment there exceeds what the section bears. Lobatto points (3,
/// 5), or, of 4, the rule of degree 3 with end weights of 1/20: they are the length over which a hinge at a joint
/// spreads.
///
/// Depth, Lobatto: n points, which give 1.079, 0.913, 1.029 ... of the full plastic moment for n = 4, 5, 6.
/// Depth, full moment: 4 or 6 points with exact area, bending stiffness and full plastic moment, placed so that the
/// greatest error of the moment between the elastic limit and there is least (5.5 % and 2.1 %). REQUIRES: a spec that
/// check_spec has passed.
SectionRule make_section_rule(const SectionSpec& spec);

}  // namespace cellcrush
