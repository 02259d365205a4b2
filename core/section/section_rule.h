#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/scene_spec.h"

namespace cellcrush {

/// Sections along an element and points through its depth (Eq. 30; the table below E5b).
///
/// Displacement-based, as in the paper: Gauss points along the element; the curvature is linear (Eq. 27, E5a).
/// Force-based (E5b): both joints are sections, so no joint carries more moment than its section does. 3 or 5 sections
/// are Lobatto points. 4 sections are the rule of degree 3 with end weights of 1/20, the length of a plastic hinge at a
/// joint over the element length.
///
/// Through the depth, Lobatto: n points; they carry 1.079, 0.913, 1.029 ... of the full plastic moment for n = 4, 5, 6.
/// Through the depth, full moment: 4 or 6 points with exact area, bending stiffness and full plastic moment. Their
/// positions minimize the greatest error of the moment between the elastic limit and the full plastic moment (5.5 % and
/// 2.1 %).
/// REQUIRES: a spec that check_spec has passed.
SectionRule make_section_rule(const SectionSpec& spec);

}  // namespace cellcrush
