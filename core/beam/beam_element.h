#pragma once

#include "beam/beam_section.h"
#include "beam/deformation.h"
#include "beam/section_curvatures.h"
#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "section/fibres.h"

namespace cellcrush {

/// Forces by which an element resists (Eq. 31, 32), in the fixed frame: N and N mm. The force on the start node is the
/// reverse of that on the end node.
struct ElementForces {
  Vector2 force_on_end = Vector2::Zero();
  double moment_on_start = 0.0;
  double moment_on_end = 0.0;
};

/// Rotations of an element's ends over a step, times h / l.
struct Bend {
  double start;
  double end;
};

/// Returns the fibres of all sections under given increments of curvature, and sums them.
template <int kDepthPoints, bool kHardening, class T>
ElementSums return_element(const Material& material, const SectionRule& rule, double membrane,
                           const PerSection& curvature, const Fibres<T>& fibres, FibreStep next) {
  ElementSums element;
  for (std::size_t i = 0; i < rule.section_count(); ++i) {
    const std::size_t first = i * rule.depth_count();
    const SectionSums section = return_section<kDepthPoints, kHardening>(material, rule, membrane, curvature[i], fibres,
                                                                         first, next.from(first));
    const double s = rule.along[static_cast<Eigen::Index>(i)];
    const double weight = rule.along_weight[static_cast<Eigen::Index>(i)];
    element.axial += weight * section.axial;
    element.moments.start += weight * (4.0 - 6.0 * s) * section.moment;
    element.moments.end += weight * (2.0 - 6.0 * s) * section.moment;
    element.plastic_work += weight * section.plastic_work;
    element.moment[i] = section.moment;
  }
  return element;
}

/// Passes of a force-based element; one is enough in 97 of 100 steps of an element.
inline constexpr int kMostPasses = 4;

/// The same for a force-based element: curvature is moved between the sections until their moments lie on a line.
template <int kDepthPoints, bool kHardening, class T>
ElementSums return_balanced(const Material& material, const SectionRule& rule, double membrane, Bend bend,
                            const EndMoments& before, const Fibres<T>& fibres, FibreStep next,
                            SectionMemory<T> memory) {
  const bool straight = is_straight(rule, memory);
  PerSection curvature = straight ? straight_curvatures(rule, bend.start, bend.end)
                                  : balanced_curvatures(rule, material, before, memory, bend.start, bend.end);
  ElementSums element = return_element<kDepthPoints, kHardening>(material, rule, membrane, curvature, fibres, next);
  if (straight && element.plastic_work == 0.0) {
    return element;  // elastic: in balance by itself, and nothing to remember
  }
  const PerSection moment_before = moments_of_sections(rule, before, memory);
  for (int pass = 1;
       !remember_sections(rule, material, moment_before, element, curvature, memory) && pass < kMostPasses; ++pass) {
    const PerSection moved = balanced_curvatures(rule, material, element.moments, memory, 0.0, 0.0);
    for (std::size_t i = 0; i < rule.section_count(); ++i) {
      curvature[i] += moved[i];
    }
    element = return_element<kDepthPoints, kHardening>(material, rule, membrane, curvature, fibres, next);
  }
  return element;
}

/// Integrates the fibres of a straight two-node element over a step and gives its nodal forces in the fixed frame
/// (Eq. 24-32).
///
/// `previous_length` is the length of the material frame, at the start of the step (l_a). `moments` are those on the nodes
/// over b h^2, then, which only a force-based element looks at, and are brought up to date.
/// Adds the plastic work of the step (stress after the return times plastic strain increment times volume, N mm) to
/// `plastic_work`. `memory` is that of a force-based element's sections and is not touched otherwise. The elastic element is
/// the cubic beam either way, so the stable step is the same.
///
/// Deviations: strains are taken over the mean length of the step (Eq. 24-26 take l_a), with which a way there and back leaves
/// no strain and the work of the forces is that of the stresses; the shear force of Eq. 31 takes the current length, with which alone angular momentum is kept; the forward
/// rotation of Eq. 32 is the current axis itself, so no rotation matrix and no sign convention are needed.
template <int kDepthPoints, bool kHardening, class T>
ElementForces evaluate_element(const Deformation& deformation, double previous_length, const Material& material,
                               const BeamSection& section, const SectionRule& rule, const Fibres<T>& fibres,
                               SectionMemory<T> memory, EndMoments& moments, double& plastic_work) {
  const double mean_length = 0.5 * (previous_length + deformation.length);
  const double membrane = deformation.stretch / mean_length;
  const double slenderness = section.thickness / mean_length;
  const Bend bend = {slenderness * deformation.rotation_start, slenderness * deformation.rotation_end};
  std::array<double, kMostFibres> stress;
  std::array<double, kMostFibres> plastic_increment;
  const FibreStep next = {stress.data(), plastic_increment.data()};
  const double unit = section.area * section.thickness;
  const ElementSums sums =
      rule.force_based
          ? return_balanced<kDepthPoints, kHardening>(material, rule, membrane, bend, moments, fibres, next, memory)
          : return_element<kDepthPoints, kHardening>(material, rule, membrane,
                                                     straight_curvatures(rule, bend.start, bend.end), fibres, next);
  commit_fibres<kHardening>(material, rule.fibre_count(), next, fibres);
  plastic_work += section.volume * sums.plastic_work;
  moments = sums.moments;
  const double moment_start = unit * sums.moments.start;
  const double moment_end = unit * sums.moments.end;
  const double shear = -(moment_start + moment_end) / deformation.length;  // Eq. 31
  return {section.area * sums.axial * deformation.axis + shear * normal_of(deformation.axis), moment_start, moment_end};
}

}  // namespace cellcrush
