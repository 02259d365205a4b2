#pragma once

#include "beam/deformation.h"
#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "section/fibres.h"

namespace cellcrush {

/// The rectangular section of an element.
struct BeamSection {
  double thickness;  ///< h, mm
  double area;       ///< b h, mm^2
};

/// Integrates the fibres of a straight two-node element over a step and gives its nodal forces in the fixed frame
/// (Eq. 24-32).
///
/// `previous_length` is the length of the material frame, at the start of the step (l_a). Adds the plastic work of the step
/// (stress after the return times plastic strain increment times volume, N mm) to `plastic_work`.
///
/// Deviations: the shear force of Eq. 31 takes the current length, with which alone angular momentum is kept; the forward
/// rotation of Eq. 32 is the current axis itself, so no rotation matrix and no sign convention are needed.
inline ElementForces evaluate_element(const Deformation& deformation, double previous_length, const Material& material,
                                      const BeamSection& section, const SectionRule& rule, Fibres fibres,
                                      double& plastic_work) {
  const double membrane_strain = deformation.stretch / previous_length;
  const double bending_scale = section.thickness / previous_length;
  const FibreSums sums = integrate_fibres(material, rule, membrane_strain, bending_scale * deformation.rotation_start,
                                          bending_scale * deformation.rotation_end, fibres);
  const double axial_force = section.area * sums.axial;  // Eq. 28, row by row
  const double moment_start = section.area * section.thickness * sums.moment_start;
  const double moment_end = section.area * section.thickness * sums.moment_end;
  plastic_work += section.area * previous_length * sums.plastic_work;

  const double shear = -(moment_start + moment_end) / deformation.length;  // Eq. 31
  return {axial_force * deformation.axis + shear * normal_of(deformation.axis), moment_start, moment_end};
}

}  // namespace cellcrush
