#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/scene_spec.h"

namespace cellcrush {

struct MeshMeasures;

/// Largest stable step of a free element (Eq. 2, 3, E11, E11b). Its length is l, its thickness h, its lumped masses are
/// s rho A l / 2 and its rotary inertias q m gamma^2. The step is the smaller of two,
///   dt = sqrt(s) (l / c) min(1, sqrt(q / 3) / sqrt(1 + 4 q gamma^2 / l^2)),  c = sqrt(E / rho),  gamma^2 = h^2 / 12,
/// that of the axial mode and that of the mode in which both nodes turn the same way. With real masses, s = q = 1, the
/// latter governs. The step is a lower bound for a lattice of such elements, accurate to 2 %.
double stable_step_of_element(double length, double thickness, const Material& material, const MassScaling& scaling);

/// The same of a free pair of such elements, whose common node has no rotation and whose rotary inertia is at its ends
/// (E11c):
///   dt = sqrt(s) (l / c) min(1, 2 / sqrt(w)),  w = (a + sqrt(a^2 - 192 g / q)) / 2,  a = 4 / q + 48 g,
///   g = gamma^2 / l^2.
/// The second mode is the one in which both ends turn in opposite senses.
double stable_step_of_pair(double length, double thickness, const Material& material, const MassScaling& scaling);

/// Fraction of the stable step of displacement-based elements, and of contacts, that is used.
inline constexpr double kStepFraction = 0.9;
/// The same of force-based elements, single or in pairs: their ledger opens with the step (core/time-step.md).
inline constexpr double kForceBasedStepFraction = 0.8;

/// Travel of the plate, or approach of a frame's beams, in a step: greatest fraction of the thinnest wall's thickness.
inline constexpr double kTravelPerStep = 0.09;
/// Travel of the plate in a step over the length of the shortest force-based element: about the greatest turn in a step
/// of the elements at the front.
inline constexpr double kTurnPerStep = 0.02;

/// Steps that the undeformed mesh allows, s. Attached masses only raise them.
struct MeshSteps {
  double stable = 0.0;       ///< the least stable step of all elements and pairs
  double accurate = 0.0;     ///< the part of it that is used
  double of_elements = 0.0;  ///< the least stable step without pairs: by it contacts are made stiff (E9)
};
MeshSteps steps_of(const Scene& scene);

/// Calls visit(block, wall, step without pairs, stable step) for all walls, in s: the steps of their elements.
template <class Visit>
void visit_steps_of_walls(const Scene& scene, const Visit& visit) {
  const Walls& walls = scene.walls;
  for (const WallBlock& block : walls.blocks) {
    const bool in_pairs = scene.section.force_based && block.has_pairs();
    for (int w = block.first_wall; w < block.first_wall + block.walls; ++w) {
      const double length = walls.undeformed_length[w];
      const Material& material = scene.materials[walls.material[w]];
      const double alone = stable_step_of_element(length, walls.thickness[w], material, scene.mass_scaling);
      visit(block, w, alone,
            in_pairs ? stable_step_of_pair(length, walls.thickness[w], material, scene.mass_scaling) : alone);
    }
  }
}

struct TimeStep {
  double seconds = 0.0;
  StepBound bound = StepBound::asked_for;
};

/// The step of a run: the one that is given, or the least of
///  - 0.8 of the stable step of an element (E11b) or a pair (E11c), or 0.9 of it if elements are displacement-based,
///  - the time in which the plate moves by 0.09 of the thinnest wall (walls approach each other by up to 1.7 times as
///    much in a step, and a new contact can be as deep); the same of the beams of a frame that approach each other
///    or a rigid wall,
///  - the time in which the plate moves by 0.02 of the shortest element, if elements are force-based,
///  - 0.9 of the bound of a row of the lightest particles between contacts (E12, scene/contact_law.h), also with a
///    light rigid wall that swings against them (E12b),
///  - for squares and triangles, the step for which omega dt of the lightest particle on its contact is 0.3 rad times
///    n V / (1.44 sqrt(sigma_y / rho)), with n elements per wall; at most 0.3 rad and at least an eighth of it.
///
/// Reason for the last: their walls lie along the crush and are stacked. Contacts between them oscillate against each
/// other and create energy: more in slow crushes and on coarse meshes. core/time-step.md has the range of crushes.
TimeStep time_step_of(const SceneSpec& spec, const MeshMeasures& mesh, const ContactLaw& contact, const Plates& plates);

}  // namespace cellcrush
