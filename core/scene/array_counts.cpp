#include "scene/array_counts.h"

#include "cellcrush/tuning.h"

namespace cellcrush {
namespace {

unsigned flag(bool is_set, Needs need) { return is_set ? need : kAlways; }

void add_faces(const ContactFaces& faces, ArrayCounts& counts) {
  counts.has |= kFaces;
  counts[Per::thick_end] = faces.thick_ends.size();
  for (const FacesOfBand& of_band : faces.bands) {
    counts[Per::face] += of_band.number.size();
    counts[Per::corner] += of_band.particle.size();
    counts[Per::face_group] += static_cast<std::size_t>(of_band.group_count());
    counts[Per::group_member] += of_band.member.size();
  }
  counts[Per::border_particle] = faces.border.size();
}

}  // namespace

ArrayCounts count_mesh(const Scene& scene) {
  const std::size_t particles = scene.particle_count();
  const std::size_t elements = scene.element_count();
  ArrayCounts counts;
  counts.has = flag(scene.has_hardening(), kHardening) | flag(!scene.has_hardening(), kNoHardening) |
               flag(scene.section.force_based, kForceBased) | flag(scene.single_fibres, kSingleFibres) |
               flag(!scene.single_fibres, kDoubleFibres) | flag(scene.is_loaded(), kLoads) |
               flag(!scene.supports.empty(), kSupports) | flag(!scene.initial_velocity.empty(), kInitialMotion);
  counts[Per::particle] = particles;
  counts[Per::joint] = static_cast<std::size_t>(scene.joint_count);
  counts[Per::element] = elements;
  counts[Per::fibre] = elements * scene.fibre_count();
  counts[Per::section] = elements * scene.section.section_count();
  counts[Per::wall] = scene.walls.start.size();
  counts[Per::wall_block] = scene.walls.blocks.size();
  counts[Per::wall_chunk] = static_cast<std::size_t>(scene.walls.chunk_count());
  counts[Per::moved_chunk] = particles / kParticlesMovedTogether + 2;  // joints and others are divided apart
  counts[Per::band] = 1;
  counts[Per::rigid_body] = scene.rigid.count();
  counts[Per::cell] = elements + 1 > particles ? elements + 1 - particles : 0;  // Euler
  return counts;
}

void add_contact(const ContactLaw& contact, const Plates& plates, ArrayCounts& counts) {
  const bool plates_rub = plates.friction > 0.0;
  const bool walls_rub = contact.friction > 0.0;
  counts.has |= flag(contact.present, kContact) | flag(plates.present, kPlates) | flag(plates_rub, kPlateFriction) |
                flag(walls_rub, kWallFriction) | flag(plates_rub || walls_rub, kFriction);
  counts[Per::cell] = plates.present ? counts[Per::cell] : 0;
}

void add_expected_faces(ArrayCounts& counts) {
  counts.has |= kFaces;
  counts[Per::face] = counts[Per::element] + 2 - counts[Per::particle];
  counts[Per::corner] = 2 * counts[Per::element];
  counts[Per::face_group] = counts[Per::face] / kFacesPerGroup + 2;
  counts[Per::group_member] = counts[Per::corner];
}

ArrayCounts counts_of(const Scene& scene) {
  ArrayCounts counts = count_mesh(scene);
  add_contact(scene.contact, scene.plates, counts);
  counts[Per::band] = scene.bands.size();
  counts[Per::limited_pair] = scene.limited_reaches.segment.size();
  if (scene.faces.are_enough()) {
    add_faces(scene.faces, counts);
  } else if (scene.contact.present) {
    counts.has |= kBuckets;
  }
  return counts;
}

}  // namespace cellcrush
