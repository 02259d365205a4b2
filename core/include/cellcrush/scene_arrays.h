#pragma once

#include "cellcrush/scene.h"

namespace cellcrush {

// The one list of the scene's arrays: memory and large pages go by it. Each function takes its structure apart, so that
// a new field does not compile until it is listed. They call visit(array).

template <class Visitor>
void visit_arrays(const FacesOfBand& faces, Visitor&& visit) {
  const auto& [number, offset, corner_end, particle, element, is_outer_whole, group_offset, member_offset, member] =
      faces;
  const auto list = [&visit](const auto&... arrays) { (visit(arrays), ...); };
  list(number, offset, corner_end, particle, element, group_offset, member_offset, member);
}

template <class Visitor>
void visit_arrays(const Scene& scene, Visitor&& visit) {
  const auto& [position, mass, inertia, inverse_mass, inverse_inertia, radius, largest_radius, smallest_radius,
               elements, walls, bands, rigid, pins, incidence_offset, incidence, joint_count, wall_end_offset,
               wall_ends, supports, motions, loads, element_loads, gravity, initial_velocity, initial_spin, depth,
               materials, law, section, single_fibres, slow_loading, constant_area, contact, limited_reaches, faces,
               plates, rigid_walls, mass_scaling, mass_damping, schedule, length, width, total_mass, stable_step,
               collapse_stress, fidelity, watched] = scene;
  const auto& [blocks, chunk_offset, first_joint, end_joint, start, end, thickness, undeformed_length, material] =
      walls;
  const auto& [rigid_offset, centre, rigid_mass, rigid_inertia, first_element] = rigid;
  const auto& [pin_offset, pin_joint] = pins;
  const auto& [reach_offset, segment, reach] = limited_reaches;
  const auto& [premise, side, thick_ends, faces_of_bands, border] = faces;
  const auto list = [&visit](const auto&... arrays) { (visit(arrays), ...); };
  list(position, mass, inertia, inverse_mass, inverse_inertia, radius, elements, bands, incidence_offset, incidence,
       wall_end_offset, wall_ends, supports, motions, loads, element_loads, initial_velocity, initial_spin, materials,
       rigid_walls, watched);
  list(blocks, chunk_offset, first_joint, end_joint, start, end, thickness, undeformed_length, material);
  list(rigid_offset, centre, rigid_mass, rigid_inertia);
  list(pin_offset, pin_joint);
  list(reach_offset, segment, reach);
  list(side, thick_ends, border);
  for (const FacesOfBand& of_band : faces_of_bands) {
    visit_arrays(of_band, visit);
  }
}

}  // namespace cellcrush
