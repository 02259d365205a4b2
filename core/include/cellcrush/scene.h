#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "cellcrush/contact_faces.h"
#include "cellcrush/laws.h"
#include "cellcrush/loads.h"
#include "cellcrush/sample.h"
#include "cellcrush/vector.h"
#include "cellcrush/walls.h"

namespace cellcrush {

/// Greatest thickness of a squashed wall over that before loading (E5f).
inline constexpr double kMostThickening = 2.0;

/// A function that starts at 0, is linear between its edges and goes on as a power: with z = min(x, end),
/// y = sum of bend (z - edge) over the edges below z, + last ((x / end)^exponent - 1) beyond the end.
struct BentLine {
  std::vector<double> edges;  ///< ascending
  std::vector<double> bends;  ///< change of the slope at each
  double end = std::numeric_limits<double>::infinity();
  double last = 0.0;
  double exponent = 0.0;
};

/// Elastic-plastic law of the fibres (E6).
struct Material {
  double youngs_modulus = 0.0;  ///< E, MPa
  double yield_stress = 0.0;    ///< MPa
  LawParameters law;            ///< in plane strain, those of the wall (E6b)
  double density = 0.0;         ///< tonne / mm^3
  bool plane_strain = false;    ///< in plastic flow: squashed walls grow in thickness alone, not in depth (E5f)
  bool strip = false;           ///< bends elastically in plane stress all the same (E6b)
  BentLine hardening;           ///< of the table: stress beyond the yield stress over plastic strain, MPa (E6d)
  BentLine rate;                ///< of the table or Johnson and Cook: factor - 1 over ln(ep' s) (E6e)
};

/// Integration points of an element: P sections along it, at s = x / l, times D points through its depth (Eq. 30, E5b);
/// F = P D fibres, section by section. Either set of weights integrates over a length of 1 and sums to 1.
struct SectionRule {
  /// True: linear moment along the element (E5b). False: linear curvature (Eq. 27, E5a).
  bool force_based = false;
  Eigen::ArrayXd along;          ///< P, s of the sections
  Eigen::ArrayXd along_weight;   ///< P
  Eigen::ArrayXd offset;         ///< D, y / h of the points; y is the distance from the axis, positive to the left
  Eigen::ArrayXd depth_weight;   ///< D
  double shear_factor = 0.0;     ///< kappa of E5i; 0: the walls do not shear
  bool coupled_bending = false;  ///< bending over the current length (E5j)

  [[nodiscard]] std::size_t section_count() const { return static_cast<std::size_t>(along.size()); }
  [[nodiscard]] std::size_t depth_count() const { return static_cast<std::size_t>(offset.size()); }
  [[nodiscard]] std::size_t fibre_count() const { return section_count() * depth_count(); }
};

/// Penalty contact between walls (Eq. 41-43, E8, E9).
struct ContactLaw {
  bool present = false;
  double stiffness = 0.0;      ///< k, N/mm
  double damping_ratio = 0.0;  ///< zeta, fraction of critical damping
  double friction = 0.0;       ///< Coulomb's coefficient
  double skin = 0.0;           ///< mm, distance beyond touch up to which candidates are collected
  double face_skin = 0.0;      ///< mm, the same in the search by faces
  double thinnest = 0.0;       ///< h_min, mm, thickness of the thinnest wall
  /// mm, by which walls may approach in a step; a run in which they do so by more is ended. 0: not checked.
  double most_travel = 0.0;
  bool bends = false;  ///< segments bend between their nodes (E8e), as those of frames do
};

/// Pairs of ball and segment whose reach is limited, or will be as walls grow thicker, because a short path along the
/// walls joins them (E8a, contact/topology/wall_paths.h). N particles.
struct LimitedReaches {
  std::vector<int> offset;    ///< N + 1, by ball, into the other arrays; empty if there are no such pairs
  std::vector<int> segment;   ///< ascending for each ball
  std::vector<double> reach;  ///< mm, the greatest
};

/// A ball that overlaps a wall before loading (E8f, contact/topology/initial_overlap.h). Until it has parted from the
/// wall, the reach between them is at most the distance at which they stand.
struct StartOverlap {
  int ball = 0;
  int ball_wall = 0;      ///< a wall of the ball, if possible one that shares a joint with the other, as listed
  int wall = 0;           ///< the wall that it overlaps, as listed (ListOrder)
  int nearest = 0;        ///< the element of that wall that is nearest to the ball before loading
  int first_segment = 0;  ///< the elements of the wall: this one and those `stride` apart, before end_segment
  int end_segment = 0;
  int stride = 1;
  int chain = -1;      ///< of the segments, where walls can break (Scene::chain); otherwise -1
  double reach = 0.0;  ///< mm, the greatest until they have parted

  [[nodiscard]] bool is_between(int segment) const {
    return segment >= first_segment && segment < end_segment && (segment - first_segment) % stride == 0;
  }
};

/// All of them, P, by ball and wall. N particles.
struct StartOverlaps {
  std::vector<int> offset;          ///< N + 1, by ball, into pairs; empty if there are none
  std::vector<StartOverlap> pairs;  ///< P

  [[nodiscard]] bool empty() const { return pairs.empty(); }
  /// The pairs of walls, as listed, the lower number first; ascending, each once.
  [[nodiscard]] std::vector<std::pair<int, int>> walls() const;
};

/// Fictitious masses (E11b): real masses times `mass`, real rotary inertias times `mass` and `rotary`.
struct MassScaling {
  double mass = 1.0;
  double rotary = 1.0;
};

/// The bound that determined the time step (scene/time_step.h).
enum class StepBound { asked_for, elements, plate_travel, approach, contacts, stacked_walls };

/// Length of the run and intervals of its output, in steps.
struct Schedule {
  double time_step = 0.0;  ///< s
  StepBound bound = StepBound::asked_for;
  std::int64_t step_count = 0;  ///< planned, if the speed of the plate is controlled
  RunEnd end = RunEnd::time;    ///< at step_count
  std::int64_t sample_interval = 0;
  std::int64_t frame_interval = 0;
  double end_strain = 0.0;   ///< of a crush by rigid walls, whose strain is not known beforehand; 0: no end
  double end_at_rest = 0.0;  ///< fraction of the greatest kinetic energy (RestWatch in step/rest_watch.h); 0: no end
};

/// Everything that stays constant during a run. Built and checked by build_scene; units mm, tonne, s, N, MPa. N
/// particles, E elements.
struct Scene {
  // Mesh.
  std::vector<Vector2> position;       ///< N, before loading
  std::vector<double> mass;            ///< N, tonne (Eq. 1, 2, E1)
  std::vector<double> inertia;         ///< N, tonne mm^2 (Eq. 1, 3, E1)
  LaneVector<double> inverse_mass;     ///< N, 1 / tonne
  LaneVector<double> inverse_inertia;  ///< N
  /// N, mm, R of the contact ball: half of the thickness of the thickest wall at the particle.
  std::vector<double> radius;
  double largest_radius = 0.0;    ///< mm
  double smallest_radius = 0.0;   ///< mm
  std::vector<Element> elements;  ///< E
  Walls walls;                    ///< W
  /// Of a large lattice, each adjacent to the one before (contact/topology/bands.h); otherwise one.
  std::vector<LatticeBand> bands;
  RigidBodies rigid;
  ListOrder list_order;
  Pins pins;
  std::vector<int> incidence_offset;  ///< N + 1, into incidence
  std::vector<int> incidence;         ///< elements at each particle, ascending
  int joint_count = 0;  ///< joints come first, those of rigid bodies before all others; particles inside walls follow
  std::vector<int> wall_end_offset;  ///< joints + 1, into wall_ends
  /// Ends of walls at each joint, as ascending indices into State::wall_force: the order of the sums.
  std::vector<int> wall_ends;
  std::vector<Support> supports;      ///< N, or empty if nothing is held
  std::vector<TimeFunction> motions;  ///< mm or rad, imposed displacements of held particles
  std::vector<Grip> grips;
  std::vector<int> gripped;  ///< particles, grip by grip
  Period period;
  /// The mesh between its copies at either side, for contacts across the sides (contact/repeated_mesh.h); null unless
  /// they repeat.
  std::shared_ptr<const Scene> repeated;
  int first_ball = 0;  ///< of the particles that touch elements
  int ball_count = 0;  ///< 0: all particles
  std::vector<NodalLoad> loads;
  std::vector<ElementLoad> element_loads;
  Vector2 gravity = Vector2::Zero();      ///< mm/s^2
  std::vector<Vector2> initial_velocity;  ///< N, or empty if all particles start at rest
  std::vector<double> initial_spin;       ///< N, or empty

  // Model.
  double depth = 0.0;               ///< b, mm
  std::vector<Material> materials;  ///< at least one
  std::size_t law = 0;              ///< of the fibres, into Laws
  SectionRule section;
  bool single_fibres = false;  ///< fibre histories are stored and updated in single precision
  /// E, where walls can break (E6g): number of the wall, or of its part between breaks. Every unit of elements that are
  /// solved together is then one of `walls`, so that all walls end at joints. Otherwise empty.
  std::vector<int> chain;
  std::size_t listed_walls =
      0;  ///< walls as listed, where these have been divided (units, arms of joints); otherwise 0
  /// Single precision was asked for, but would round so slow a loading away (scene/run_plan.h).
  bool slow_loading = false;
  bool constant_area = false;  ///< walls keep their section area, as in the paper, instead of their volume (E5c)
  ContactLaw contact;
  LimitedReaches limited_reaches;  ///< empty without contact
  StartOverlaps start_overlaps;    ///< empty without contact; of new ends too, where walls can break
  ContactFaces faces;              ///< for the contact search, where their premise holds
  Plates plates;
  std::vector<RigidWall> rigid_walls;
  std::optional<CrushingWalls> crushing_walls;  ///< none between plates
  MassScaling mass_scaling;
  double mass_damping = 0.0;  ///< alpha, 1/s: force -alpha m v
  Schedule schedule;

  // Measures of the whole, for reports.
  double length = 0.0;           ///< envelope along the crush, mm; reference length of the strain
  double width = 0.0;            ///< envelope across the crush, mm
  double total_mass = 0.0;       ///< real, tonne
  double solid_area = 0.0;       ///< of the walls before loading, mm^2, joints counted once (scene/solid_area.h)
  double stable_step = 0.0;      ///< s, of the undeformed mesh (E11b, scene/time_step.h)
  double collapse_stress = 0.0;  ///< MPa, quasi-static plastic collapse after Gibson and Ashby; 0 if unknown
  std::string fidelity;          ///< what the fidelity filled in, as a sentence; empty without one

  std::vector<int> watched;  ///< particles whose displacements are recorded in samples

  /// Radius plus half thickness before loading, mm (E8).
  [[nodiscard]] double full_reach_of(int ball, int segment) const {
    return radius[ball] + 0.5 * elements[segment].thickness;
  }
  /// Greatest distance at which a ball and a segment touch once parted, mm (E8a); infinite if no short path joins them.
  [[nodiscard]] double most_reach_of(int ball, int segment) const {
    if (!limited_reaches.offset.empty()) {
      for (int k = limited_reaches.offset[ball]; k < limited_reaches.offset[ball + 1]; ++k) {
        if (limited_reaches.segment[k] == segment) {
          return limited_reaches.reach[k];
        }
      }
    }
    return std::numeric_limits<double>::infinity();
  }
  /// Distance at which a ball and a segment touch once they have parted, mm (E8, E8a), with the thickness before
  /// loading.
  [[nodiscard]] double reach_of(int ball, int segment) const {
    return std::min(full_reach_of(ball, segment), most_reach_of(ball, segment));
  }

  [[nodiscard]] bool can_break() const { return !chain.empty(); }
  /// Whether an overlap concerns a segment.
  [[nodiscard]] bool has(const StartOverlap& pair, int segment) const {
    return pair.is_between(segment) && (pair.chain < 0 || pair.chain == chain[segment]);
  }
  /// Whether squashed walls grow in thickness (E5f).
  [[nodiscard]] bool thickens() const { return !constant_area; }
  /// Greatest radius that a ball can have, mm.
  [[nodiscard]] double greatest_radius() const { return (thickens() ? kMostThickening : 1.0) * largest_radius; }

  [[nodiscard]] bool is_loaded() const { return !loads.empty() || !element_loads.empty() || !gravity.isZero(); }
  [[nodiscard]] std::span<const int> particles_of(const Grip& grip) const {
    return std::span(gripped).subspan(static_cast<std::size_t>(grip.first),
                                      static_cast<std::size_t>(grip.end - grip.first));
  }
  [[nodiscard]] std::size_t particle_count() const { return position.size(); }
  [[nodiscard]] std::size_t element_count() const { return elements.size(); }
  [[nodiscard]] std::size_t rigid_element_count() const { return elements.size() - rigid.first_element; }
  /// All walls, as listed: those of `walls`, then those of rigid bodies, which are an element each.
  [[nodiscard]] std::size_t wall_count() const {
    return listed_walls > 0 ? listed_walls : walls.start.size() + rigid_element_count();
  }
  [[nodiscard]] std::size_t fibre_count() const { return section.fibre_count(); }
};

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
               elements, walls, bands, rigid, list_order, pins, incidence_offset, incidence, joint_count,
               wall_end_offset, wall_ends, supports, motions, grips, gripped, period, repeated, first_ball, ball_count,
               loads, element_loads, gravity, initial_velocity, initial_spin, depth, materials, law, section,
               single_fibres, chain, listed_walls, slow_loading, constant_area, contact, limited_reaches,
               start_overlaps, faces, plates, rigid_walls, crushing_walls, mass_scaling, mass_damping, schedule, length,
               width, total_mass, solid_area, stable_step, collapse_stress, fidelity, watched] = scene;
  const auto& [blocks, chunk_offset, first_joint, end_joint, start, end, thickness, undeformed_length, material,
               shear] = walls;
  const auto& [rigid_offset, centre, rigid_mass, rigid_inertia, first_element, are_joints, links] = rigid;
  const auto& [listed_joint, listed_wall] = list_order;
  const auto& [pin_offset, pin_joint] = pins;
  const auto& [period_axis, period_length, period_is_fixed, low_joint, high_joint] = period;
  const auto& [reach_offset, segment, reach] = limited_reaches;
  const auto& [overlap_offset, overlap_pairs] = start_overlaps;
  const auto& [premise, side, thick_ends, faces_of_bands, border] = faces;
  const auto list = [&visit](const auto&... arrays) { (visit(arrays), ...); };
  list(position, mass, inertia, inverse_mass, inverse_inertia, radius, elements, bands, incidence_offset, incidence,
       wall_end_offset, wall_ends, supports, motions, grips, gripped, loads, element_loads, initial_velocity,
       initial_spin, materials, chain, rigid_walls, watched);
  list(blocks, chunk_offset, first_joint, end_joint, start, end, thickness, undeformed_length, material, shear);
  list(rigid_offset, centre, rigid_mass, rigid_inertia);
  list(listed_joint, listed_wall);
  list(pin_offset, pin_joint);
  list(low_joint, high_joint);
  list(reach_offset, segment, reach);
  list(overlap_offset, overlap_pairs);
  list(side, thick_ends, border);
  for (const FacesOfBand& of_band : faces_of_bands) {
    visit_arrays(of_band, visit);
  }
  if (repeated != nullptr) {
    visit_arrays(*repeated, visit);
  }
}

}  // namespace cellcrush
