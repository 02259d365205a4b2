#pragma once

#include "cellcrush/array_shape.h"
#include "cellcrush/scene.h"

namespace cellcrush {

// The one list of the scene's arrays: memory and large pages go by it. Each function takes its structure apart, so that
// a new field does not compile until it is listed. They call visitor(name, array, shape).

template <class Visitor>
void visit_arrays(const Walls& walls, Visitor&& visitor) {
  const auto& [blocks, chunk_offset, first_joint, end_joint, start, end, thickness, undeformed_length, material] =
      walls;
  visitor("walls.blocks", blocks, Per::wall_block);
  visitor("walls.chunk_offset", chunk_offset, Per::wall_chunk);
  visitor("walls.first_joint", first_joint, Per::wall_chunk);
  visitor("walls.end_joint", end_joint, Per::wall_chunk);
  visitor("walls.start", start, Per::wall);
  visitor("walls.end", end, Per::wall);
  visitor("walls.thickness", thickness, Per::wall);
  visitor("walls.undeformed_length", undeformed_length, Per::wall);
  visitor("walls.material", material, Per::wall);
}

template <class Visitor>
void visit_arrays(const RigidBodies& rigid, Visitor&& visitor) {
  const auto& [offset, centre, mass, inertia, first_element] = rigid;
  visitor("rigid.offset", offset, Per::rigid_body);
  visitor("rigid.centre", centre, Per::rigid_body);
  visitor("rigid.mass", mass, Per::rigid_body);
  visitor("rigid.inertia", inertia, Per::rigid_body);
}

template <class Visitor>
void visit_arrays(const LimitedReaches& limited, Visitor&& visitor) {
  const auto& [offset, segment, reach] = limited;
  visitor("limited_reaches.offset", offset, Shape(Per::particle, kContact));
  visitor("limited_reaches.segment", segment, Per::limited_pair);
  visitor("limited_reaches.reach", reach, Per::limited_pair);
}

template <class Visitor>
void visit_arrays(const FacesOfBand& faces, Visitor&& visitor) {
  const auto& [number, offset, corner_end, particle, element, is_outer_whole, group_offset, member_offset, member] =
      faces;
  visitor("faces.number", number, Per::face);
  visitor("faces.offset", offset, Per::face);
  visitor("faces.corner_end", corner_end, Per::face);
  visitor("faces.particle", particle, Per::corner);
  visitor("faces.element", element, Per::corner);
  visitor("faces.group_offset", group_offset, Per::face_group);
  visitor("faces.member_offset", member_offset, Per::face_group);
  visitor("faces.member", member, Per::group_member);
}

template <class Visitor>
void visit_arrays(const ContactFaces& faces, Visitor&& visitor) {
  const auto& [premise, side, thick_ends, bands, border] = faces;
  visitor("faces.side", side, Shape(Per::element, kFaces, 2));
  visitor("faces.thick_ends", thick_ends, Per::thick_end);
  for (const FacesOfBand& of_band : bands) {
    visit_arrays(of_band, visitor);
  }
  visitor("faces.border", border, Per::border_particle);
}

template <class Visitor>
void visit_arrays(const Scene& scene, Visitor&& visitor) {
  const auto& [position, mass, inertia, inverse_mass, inverse_inertia, radius, largest_radius, smallest_radius,
               elements, walls, bands, rigid, incidence_offset, incidence, joint_count, wall_end_offset, wall_ends,
               supports, motions, loads, element_loads, gravity, initial_velocity, initial_spin, depth, materials,
               section, single_fibres, constant_area, contact, limited_reaches, faces, plates, mass_scaling,
               mass_damping, schedule, length, width, total_mass, stable_step, collapse_stress, fidelity, watched] =
      scene;
  visitor("position", position, Per::particle);
  visitor("mass", mass, Per::particle);
  visitor("inertia", inertia, Per::particle);
  visitor("inverse_mass", inverse_mass, Per::particle);
  visitor("inverse_inertia", inverse_inertia, Per::particle);
  visitor("radius", radius, Per::particle);
  visitor("elements", elements, Per::element);
  visit_arrays(walls, visitor);
  visitor("bands", bands, Per::band);
  visit_arrays(rigid, visitor);
  visitor("incidence_offset", incidence_offset, Per::particle);
  visitor("incidence", incidence, Shape(Per::element, kAlways, 2));
  visitor("wall_end_offset", wall_end_offset, Per::joint);
  visitor("wall_ends", wall_ends, Shape(Per::wall, kAlways, 2));
  visitor("supports", supports, Shape(Per::particle, kSupports));
  visitor("motions", motions, Per::few);
  visitor("loads", loads, Per::few);
  visitor("element_loads", element_loads, Per::few);
  visitor("initial_velocity", initial_velocity, Shape(Per::particle, kInitialMotion));
  visitor("initial_spin", initial_spin, Shape(Per::particle, kInitialMotion));
  visitor("materials", materials, Per::few);
  visit_arrays(limited_reaches, visitor);
  visit_arrays(faces, visitor);
  visitor("watched", watched, Per::few);
}

}  // namespace cellcrush
