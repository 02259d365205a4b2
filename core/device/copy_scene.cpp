#define CELLCRUSH_ON_DEVICE

#include <algorithm>
#include <bit>
#include <type_traits>
#include <utility>
#include <vector>

#include "device/device_memory.h"
#include "device/steps-inl.h"
#include "motion/integrate_motion.h"
#include "section/section_rule.h"

namespace cellcrush {
namespace {

namespace on_device = HWY_NAMESPACE;
using on_device::Array;

/// Calls visit(kind) for the kind of walls of a scene, with its index.
template <class Visit>
void visit_kind(const Scene& scene, const Visit& visit) {
  const auto is_of = [&]<class Law, class Rule, bool kForceBased>(
                         std::type_identity<on_device::EvaluateWalls<kForceBased, Law, Rule>>) {
    bool has_law = false;
    Laws::visit(scene.law, [&](auto law) { has_law = std::is_same_v<decltype(law), Law>; });
    return has_law && kForceBased == scene.section.force_based &&
           std::is_same_v<typename Rule::Number, float> == scene.single_fibres;
  };
  [&]<std::size_t... Kinds>(std::index_sequence<Kinds...>) {
    const auto visit_one = [&]<std::size_t kIndex>(std::integral_constant<std::size_t, kIndex>) {
      using Kind = std::tuple_element_t<kIndex, on_device::WallKinds>;
      if (is_of(std::type_identity<Kind>())) visit(std::type_identity<Kind>(), static_cast<int>(kIndex));
    };
    (visit_one(std::integral_constant<std::size_t, Kinds>()), ...);
  }
  (std::make_index_sequence<std::tuple_size_v<on_device::WallKinds>>());
}

void put_lists(DeviceMemory& memory, const std::vector<std::vector<int>>& lists, Array<const int>& offset,
               Array<const int>& all) {
  std::vector<int> ends = {0};
  std::vector<int> joined;
  for (const std::vector<int>& list : lists) {
    joined.insert(joined.end(), list.begin(), list.end());
    ends.push_back(static_cast<int>(joined.size()));
  }
  offset = memory.put<const int>(ends);
  all = memory.put<const int>(joined);
}

/// The faces of every ball and segment.
void put_faces(const Scene& scene, DeviceMemory& memory, on_device::Crush& crush) {
  const std::vector<int>& side = scene.faces.side;
  std::vector<std::vector<int>> of_segment(scene.element_count());
  for (std::size_t e = 0; e < of_segment.size(); ++e) of_segment[e] = {side[2 * e], side[2 * e + 1]};
  for (const ThickEnd& end : scene.faces.thick_ends) of_segment[end.element].push_back(end.face);
  std::vector<std::vector<int>> of_ball(scene.particle_count());
  for (std::size_t ball = 0; ball < of_ball.size(); ++ball) {
    for (int k = scene.incidence_offset[ball]; k < scene.incidence_offset[ball + 1]; ++k) {
      for (const int face : {side[2 * scene.incidence[k]], side[2 * scene.incidence[k] + 1]}) {
        if (std::ranges::find(of_ball[ball], face) == of_ball[ball].end()) of_ball[ball].push_back(face);
      }
    }
  }
  put_lists(memory, of_ball, crush.ball_faces_offset, crush.ball_faces);
  put_lists(memory, of_segment, crush.segment_faces_offset, crush.segment_faces);
}

void put_search(const Scene& scene, DeviceMemory& memory, on_device::Crush& crush) {
  if (!scene.contact.present) return;
  double longest = 0.0;
  for (const double length : scene.walls.undeformed_length) longest = std::max(longest, length);
  // Segments may stretch by half; beyond that the crush ends on the device.
  crush.square_size = 0.75 * longest + 2.0 * scene.greatest_radius() + scene.contact.face_skin;
  crush.first_segment = memory.room<int>(std::bit_ceil(scene.element_count()));
  crush.next_segment = memory.room<int>(scene.element_count());
  if (scene.faces.are_enough()) put_faces(scene, memory, crush);
}

}  // namespace

int copy_scene(const Scene& scene, DeviceMemory& memory, on_device::Crush& crush) {
  on_device::Scene& to = crush.scene;
  to.mass = memory.put<const double>(scene.mass);
  to.inertia = memory.put<const double>(scene.inertia);
  to.inverse_mass = memory.put<const double>(scene.inverse_mass);
  to.inverse_inertia = memory.put<const double>(scene.inverse_inertia);
  to.radius = memory.put<const double>(scene.radius);
  to.greatest_radius = scene.greatest_radius();
  to.elements = memory.put<const Element>(scene.elements);
  to.incidence_offset = memory.put<const int>(scene.incidence_offset);
  to.incidence = memory.put<const int>(scene.incidence);
  to.limited_reaches = {memory.put<const int>(scene.limited_reaches.offset),
                        memory.put<const int>(scene.limited_reaches.segment),
                        memory.put<const double>(scene.limited_reaches.reach)};
  to.wall_end_offset = memory.put<const int>(scene.wall_end_offset);
  to.wall_ends = memory.put<const int>(scene.wall_ends);
  to.walls.blocks = memory.put<const WallBlock>(scene.walls.blocks);
  to.walls.chunk_offset = memory.put<const int>(scene.walls.chunk_offset);
  to.walls.start = memory.put<const int>(scene.walls.start);
  to.walls.end = memory.put<const int>(scene.walls.end);
  to.walls.thickness = memory.put<const double>(scene.walls.thickness);
  to.walls.undeformed_length = memory.put<const double>(scene.walls.undeformed_length);
  to.walls.material = memory.put<const int>(scene.walls.material);
  to.walls.shear = memory.put<const double>(scene.walls.shear);
  std::vector<on_device::Material> materials;
  for (const Material& of : scene.materials) {
    materials.push_back({of.youngs_modulus,
                         of.yield_stress,
                         {of.law.hardening_modulus_mpa, of.law.isotropic_fraction},
                         of.plane_strain});
  }
  to.materials = memory.put<const on_device::Material>(materials);
  to.depth = scene.depth;
  to.constant_area = scene.constant_area;
  to.section = {scene.section.force_based};
  to.plates = {scene.plates.axis};
  to.contact = {scene.contact.present,  scene.contact.bends,    scene.contact.stiffness, scene.contact.damping_ratio,
                scene.contact.friction, scene.contact.thinnest, scene.contact.face_skin};
  to.mass_scaling = scene.mass_scaling;
  to.mass_damping = scene.mass_damping;
  to.schedule = {scene.schedule.time_step};
  crush.factors = on_device::step_factors_of(to);
  std::vector<ParticleRange> moved;
  for (std::size_t chunk = 0; chunk < moved_chunk_count(scene); ++chunk) moved.push_back(moved_chunk(scene, chunk));
  crush.moved = memory.put<const ParticleRange>(moved);
  int walls = 0;
  visit_kind(scene, [&]<class Kind>(std::type_identity<Kind>, int index) {
    const typename Kind::Factors factors(scene.section);
    const auto* bytes = reinterpret_cast<const unsigned char*>(&factors);
    crush.rule = memory.put<const unsigned char>(std::vector<unsigned char>(bytes, bytes + sizeof factors));
    walls = index;
  });
  put_search(scene, memory, crush);
  return walls;
}

// What a crush on a device does not have (core/device/README.md).
std::optional<std::string> why_not_on_device(const Scene& scene) {
  if (scene.bands.size() > 1) return "its lattice has 50,000 elements or more";
  if (!scene.plates.present || !scene.rigid_walls.empty()) return "it is not crushed by plates";
  if (scene.plates.kinetic_share > 0.0) return "the speed of its plate is controlled";
  if (scene.rigid.count() > 0) return "it has rigid parts";
  if (!scene.supports.empty() || scene.is_loaded()) return "it has supports or loads";
  if (scene.pins.count() > 0) return "ends of its beams are pinned";
  if (scene.contact.most_travel > 0.0) return "the approach of its parts is watched";
  if (scene.period.repeats()) return "its sides repeat";
  if (scene.can_break()) return "its walls can break";
  if (!scene.start_overlaps.empty()) return "its walls overlap before loading";
  if (scene.contact.bends) return "its segments bend";
  if (!has_known_counts(scene.section))
    return "its elements have another section rule than the default's or the paper's";
  if (Laws::kFacts[scene.law].keeps_tangent) return "the yield stress of its material follows a curve or a rate";
  return std::nullopt;
}

}  // namespace cellcrush
