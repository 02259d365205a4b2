#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "cellcrush/contact_faces.h"
#include "cellcrush/lane_vector.h"
#include "cellcrush/tuning.h"
#include "cellcrush/vector.h"

namespace cellcrush {

/// Bilinear elastic-plastic law with mixed hardening.
struct Material {
  double youngs_modulus = 0.0;      ///< E, MPa
  double yield_stress = 0.0;        ///< MPa
  double hardening_modulus = 0.0;   ///< H = E E_T / (E - E_T), MPa
  double isotropic_fraction = 1.0;  ///< beta: 1 isotropic, 0 kinematic
  double density = 0.0;             ///< tonne / mm^3
};

/// Where an element samples its stress: P sections along it, s = x / l, times D points through its depth (Eq. 30); F =
/// P D fibres, section by section. Both weights integrate over a length of 1 and sum to 1.
struct SectionRule {
  /// Whether the curvature may leave its straight line (Eq. 27) for that with which the moment stays one.
  bool force_based = false;
  Eigen::ArrayXd along;         ///< P, s of the sections
  Eigen::ArrayXd along_weight;  ///< P
  Eigen::ArrayXd offset;        ///< D, y / h of the points, y being the distance from the axis to the left
  Eigen::ArrayXd depth_weight;  ///< D

  [[nodiscard]] std::size_t section_count() const { return static_cast<std::size_t>(along.size()); }
  [[nodiscard]] std::size_t depth_count() const { return static_cast<std::size_t>(offset.size()); }
  [[nodiscard]] std::size_t fibre_count() const { return section_count() * depth_count(); }
};

/// A beam element: its nodes and its rectangular section.
struct Element {
  int start = 0;
  int end = 0;
  double thickness = 0.0;  ///< h, mm
  int material = 0;        ///< into Scene::materials
};

inline bool share_a_node(const Element& a, const Element& b) {
  return a.start == b.start || a.start == b.end || a.end == b.start || a.end == b.end;
}

/// Most fibres of an element that are kept in single precision: there is a bit for each in 32.
inline constexpr std::size_t kMostSingleFibres = 32;

/// Walls of equally many elements, side by side: element j of the block's wall w is first_element + j * walls + w, the
/// particle behind it inside the wall first_inner + j * walls + w. What elements remember lies in the same order, so
/// that a step of the chain takes the walls of a block at once.
struct WallBlock {
  int first_wall = 0;  ///< into the arrays of Walls
  int walls = 0;       ///< 1 ... kMostWallsInBlock
  int elements = 0;    ///< of each wall
  int first_element = 0;
  int first_inner = 0;
};

/// The walls between joints, W of them, block by block, in C chunks. All elements of a wall are alike.
struct Walls {
  std::vector<WallBlock> blocks;
  std::vector<int>
      chunk_offset;  ///< C + 1, into blocks: of the first of those that a thread takes at once, and their end
  std::vector<int> first_joint;           ///< C: from it on no joint has walls in an earlier chunk
  std::vector<int> end_joint;             ///< C: before it no joint has walls in a later chunk
  std::vector<int> start;                 ///< W, particle
  std::vector<int> end;                   ///< W, particle
  std::vector<double> thickness;          ///< W, mm
  std::vector<double> undeformed_length;  ///< W, of one element, mm
  std::vector<int> material;              ///< W, into Scene::materials

  [[nodiscard]] int chunk_count() const { return static_cast<int>(chunk_offset.size()) - 1; }
};

/// A part of the lattice whose walls and particles follow each other. Its balls are its particles.
struct LatticeBand {
  int first_chunk = 0;  ///< of Walls
  int end_chunk = 0;
  int first_joint = 0;  ///< particles
  int end_joint = 0;
  int first_inner = 0;  ///< particles inside walls
  int end_inner = 0;

  [[nodiscard]] bool owns(int particle) const {
    return (particle >= first_joint && particle < end_joint) || (particle >= first_inner && particle < end_inner);
  }
};

/// Parts of the lattice that move without deforming, B of them. Their particles come first, body by body, and their
/// walls, an element each, last among the elements: they bear no stress, but others touch them.
struct RigidBodies {
  std::vector<int> offset;      ///< B + 1, particles; empty: there are none
  std::vector<Vector2> centre;  ///< B, of mass, before loading, mm
  std::vector<double> mass;     ///< B, tonne
  std::vector<double> inertia;  ///< B, about the centre, tonne mm^2
  int first_element = 0;

  [[nodiscard]] std::size_t count() const { return mass.size(); }
  [[nodiscard]] int particle_count() const { return offset.empty() ? 0 : offset.back(); }
};

/// A function of time: linear between its points, constant outside.
struct TimeFunction {
  std::vector<std::pair<double, double>> points;  ///< (s, value), times ascending, at least one

  [[nodiscard]] double value_at(double time) const;
};

/// Which of a particle's three motions is meant.
enum class Component { x, y, rotation };

/// A load on a node.
struct NodalLoad {
  int node = 0;
  Component component = Component::x;
  TimeFunction value;  ///< N or N mm
};

/// A load spread evenly over an element, in the fixed frame, on its undeformed length (Eq. 4).
struct ElementLoad {
  int element = 0;
  Component component = Component::x;  ///< x or y
  TimeFunction value;                  ///< N/mm
  double length = 0.0;                 ///< undeformed, mm
};

/// What a support does with one motion of a particle.
struct Hold {
  bool held = false;
  int motion = -1;  ///< into Scene::motions: the displacement it is made to follow; -1: none, it stands
};

struct Support {
  Hold x;
  Hold y;
  Hold rotation;
};

/// The two rigid plates. The impact plate starts at the low end and moves along the crush; the support plate stands.
struct Plates {
  bool present = false;
  int axis = 0;               ///< 0: crush along x, 1: along y
  double impact_face = 0.0;   ///< mm, position of the face before loading
  double support_face = 0.0;  ///< mm
  double speed = 0.0;         ///< V, mm/s
  double ramp_time = 0.0;     ///< s over which the speed rises linearly from 0
  double stiffness = 0.0;     ///< N/mm, penalty of one particle
  double friction = 0.0;      ///< Coulomb's coefficient

  /// Speed at a time, mm/s.
  [[nodiscard]] double speed_at(double time) const;
};

/// Penalty contact between walls (Eq. 41-43).
struct ContactLaw {
  bool present = false;
  double stiffness = 0.0;      ///< k, N/mm
  double damping_ratio = 0.0;  ///< share of critical damping
  double friction = 0.0;       ///< Coulomb's coefficient
  double skin = 0.0;           ///< mm by which candidates are collected beyond touch
  double face_skin = 0.0;      ///< the same of a face's candidates
  double thinnest = 0.0;       ///< mm, least thickness of a wall
};

/// Pairs of ball and segment that touch nearer than radius and half thickness, because a short way along the walls
/// joins them (scene/wall_paths.h). N particles.
struct LimitedReaches {
  std::vector<int> offset;    ///< N + 1, by ball, into the others; empty: none
  std::vector<int> segment;   ///< ascending for each ball
  std::vector<double> reach;  ///< mm
};

/// Fictitious masses: particles' masses are the real ones times `mass`, their rotary inertia times mass and rotary.
struct MassScaling {
  double mass = 1.0;
  double rotary = 1.0;
};

/// What gave the step its length (scene/time_step.h).
enum class StepBound { asked_for, elements, plate_travel, contacts, stacked_walls };

/// When the run ends and what is taken from it, in steps.
struct Schedule {
  double time_step = 0.0;  ///< s
  StepBound bound = StepBound::asked_for;
  std::int64_t step_count = 0;
  std::int64_t sample_interval = 0;
  std::int64_t frame_interval = 0;
};

/// Everything that does not change over a run. Built and checked by build_scene; units mm, tonne, s, N, MPa.
/// N particles, E elements.
struct Scene {
  // Mesh.
  std::vector<Vector2> position;       ///< N, before loading
  std::vector<double> mass;            ///< N, tonne (Eq. 1, 2)
  std::vector<double> inertia;         ///< N, tonne mm^2 (Eq. 1, 3)
  LaneVector<double> inverse_mass;     ///< N, 1 / tonne
  LaneVector<double> inverse_inertia;  ///< N
  std::vector<double> radius;          ///< N, of the contact ball: half of the thickest wall that ends there
  double largest_radius = 0.0;         ///< mm
  double smallest_radius = 0.0;        ///< mm
  std::vector<Element> elements;       ///< E
  Walls walls;                         ///< W
  std::vector<LatticeBand> bands;      ///< of a large lattice, each beside the one before (scene/bands.h); else one
  RigidBodies rigid;
  std::vector<int> incidence_offset;  ///< N + 1, into incidence
  std::vector<int> incidence;         ///< elements at each particle, ascending
  int joint_count = 0;  ///< the joints come first, of rigid bodies first of all, then the particles inside walls
  std::vector<int> wall_end_offset;   ///< joints + 1, into wall_ends
  std::vector<int> wall_ends;         ///< at each joint, into State::wall_force, ascending: sums run in this order
  std::vector<Support> supports;      ///< N, or empty when nothing is held
  std::vector<TimeFunction> motions;  ///< mm or rad, of held particles
  std::vector<NodalLoad> loads;
  std::vector<ElementLoad> element_loads;
  Vector2 gravity = Vector2::Zero();      ///< mm/s^2
  std::vector<Vector2> initial_velocity;  ///< N, or empty when all start at rest
  std::vector<double> initial_spin;       ///< N, or empty

  // Model.
  double depth = 0.0;               ///< b, mm
  std::vector<Material> materials;  ///< at least one
  SectionRule section;
  bool single_fibres = false;  ///< fibres are kept, and returned by vectors, in single precision
  bool constant_area = false;  ///< walls that change their length keep their area (the paper) instead of their volume
  ContactLaw contact;
  LimitedReaches limited_reaches;  ///< empty without contact
  ContactFaces faces;              ///< by which contacts are searched, where their premise holds
  Plates plates;
  MassScaling mass_scaling;
  double mass_damping = 0.0;  ///< alpha, 1/s: force -alpha m v
  Schedule schedule;

  // Measures of the whole, for reports.
  double length = 0.0;           ///< envelope along the crush, mm; strain counts from it
  double width = 0.0;            ///< envelope across the crush, mm
  double total_mass = 0.0;       ///< real, tonne
  double stable_step = 0.0;      ///< s, of the undeformed mesh (see scene/stable_step.h)
  double collapse_stress = 0.0;  ///< MPa, quasi-static plastic collapse after Gibson and Ashby; 0 when unknown
  std::string fidelity;          ///< what it filled in, a sentence; empty without one

  std::vector<int> watched;  ///< particles whose motion samples keep

  [[nodiscard]] bool has_hardening() const {
    return std::any_of(materials.begin(), materials.end(),
                       [](const Material& material) { return material.hardening_modulus > 0.0; });
  }
  /// Distance at which a ball and a segment touch, mm.
  [[nodiscard]] double reach_of(int ball, int segment) const {
    if (!limited_reaches.offset.empty()) {
      for (int k = limited_reaches.offset[ball]; k < limited_reaches.offset[ball + 1]; ++k) {
        if (limited_reaches.segment[k] == segment) {
          return limited_reaches.reach[k];
        }
      }
    }
    return radius[ball] + 0.5 * elements[segment].thickness;
  }

  [[nodiscard]] bool is_loaded() const { return !loads.empty() || !element_loads.empty() || !gravity.isZero(); }
  [[nodiscard]] std::size_t particle_count() const { return position.size(); }
  [[nodiscard]] std::size_t element_count() const { return elements.size(); }
  [[nodiscard]] std::size_t fibre_count() const { return section.fibre_count(); }
};

}  // namespace cellcrush
