#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "cellcrush/laws.h"
#include "cellcrush/loads_spec.h"
#include "cellcrush/optional_box.h"

namespace cellcrush {

// A spec has m and g, a scene mm and tonne.
inline constexpr double kMmPerM = 1e3;
inline constexpr double kTonnePerGram = 1e-6;

// The request of a user, before any check. This is the boundary: names carry units and equal the field paths of a case
// ("loading.speed_m_per_s"). Scene holds the same in the units of the solver (mm, tonne, s, N, MPa).
// A std::optional must be given where it applies, unless its comment names a default; if missing, it is reported.
// An enum lists its values in the order of the case's enum, whose 0 is unspecified (server/translate/case_to_spec.cpp).

/// A lattice of equal cells. Its kind says how cells lie and are counted (core/lattice/kinds).
struct RegularLattice {
  std::string kind;  ///< one of lattice_names(): "hexagon" for lattice.hexagon
  std::optional<int> columns;
  std::optional<int> rows;
  std::optional<double> side_mm;
  std::optional<double> wall_thickness_mm;
  std::map<std::string, double> own;  ///< numbers that only this kind has, by the names of their fields

  bool operator==(const RegularLattice&) const = default;
};

struct MaterialSpec : LawParameters {
  std::optional<double> youngs_modulus_mpa;
  std::optional<double> yield_stress_mpa;
  /// Whether a wall can contract along the depth of the lattice (stress), is held (strain), or is held in plastic flow
  /// alone (strip, E6b). Held walls yield at 2 / sqrt 3 of the yield stress.
  enum class Plane { stress, strain, strip };
  Plane plane = Plane::stress;
  /// In plane strain it replaces E by E / (1 - nu^2); of walls that shear it gives the shear modulus (E5i). Otherwise
  /// not used.
  double poissons_ratio = 0.33;
  std::optional<double> density_kg_per_m3;

  bool operator==(const MaterialSpec&) const = default;
};

/// Any planar lattice: joints, and the walls between them, as lists of numbers.
struct NetworkWalls {
  std::vector<double> joints_mm;            ///< x and y of each joint
  std::vector<int> walls;                   ///< start and end of each wall, as indices of joints
  std::optional<double> wall_thickness_mm;  ///< of every wall, unless `thicknesses_mm` is given
  std::vector<double> thicknesses_mm;       ///< of each wall
  /// Of each wall: rise of a circular arc over its chord, to the left of start to end. Empty: straight.
  std::vector<double> rises_mm;
  std::vector<MaterialSpec> materials;  ///< besides that of the spec
  std::vector<int> wall_materials;      ///< of each wall: 0 that of the spec, 1 the first of `materials`. Empty: 0

  [[nodiscard]] std::size_t joint_count() const { return joints_mm.size() / 2; }
  [[nodiscard]] std::size_t wall_count() const { return walls.size() / 2; }
  bool operator==(const NetworkWalls&) const = default;
};

/// A Voronoi honeycomb: the walls between the cells of nuclei that keep a least distance (lattice/voronoi.h).
struct VoronoiWalls {
  std::optional<int> columns;
  std::optional<int> rows;
  std::optional<double> side_mm;  ///< of the regular hexagons
  std::optional<double> irregularity;
  int relaxation_steps = 0;
  std::uint64_t seed = 0;
  std::optional<double> wall_thickness_mm;  ///< unless `relative_density` is given
  std::optional<double> relative_density;
  bool edge_walls = false;

  bool operator==(const VoronoiWalls&) const = default;
};

/// Walls that are listed one by one: an explicit planar frame. Nodes are named by their index in `nodes`.
struct FrameWalls {
  struct Node {
    double x_mm = 0.0;
    double y_mm = 0.0;
    double attached_mass_g = 0.0;
    double attached_inertia_g_mm2 = 0.0;
    bool operator==(const Node&) const = default;
  };
  struct Beam {
    int start = 0;
    int end = 0;
    double thickness_mm = 0.0;
    std::optional<int> elements;           ///< default: elements_per_wall of the spec
    OptionalBox<MaterialSpec> material;    ///< default: that of the spec
    bool pin_start = false;                ///< whether the beam turns freely at its start (E16)
    bool pin_end = false;
    bool operator==(const Beam&) const = default;
  };
  struct Support {
    int node = 0;
    bool fix_x = false;
    bool fix_y = false;
    bool fix_rotation = false;
    bool operator==(const Support&) const = default;
  };

  std::vector<Node> nodes;
  std::vector<Beam> beams;
  std::vector<Support> supports;
  bool self_contact = false;
  std::vector<int> watched_nodes;

  bool operator==(const FrameWalls&) const = default;
};

/// Rows of stiff cells, whose walls are thicker, in a lattice of hexagons.
struct Inclusions {
  enum class Model {
    rigid,  ///< joined cells move as one rigid body (E13)
    meshed  ///< their walls are beams like all others
  };
  std::vector<int> rows;  ///< counted from 1 at the bottom
  double thickness_factor = 4.0;
  Model model = Model::rigid;

  bool operator==(const Inclusions&) const = default;
};

/// Changes of the walls of any lattice but a frame (lattice/list_walls.h).
struct Defects {
  double missing_walls = 0.0;  ///< fraction of the walls
  double thickness_scatter = 0.0;
  std::uint64_t seed = 0;

  bool operator==(const Defects&) const = default;
};

/// Relative factors along one axis. At most one of each pair of lists is given.
struct Grading {
  enum class Axis { x, y };
  Axis axis = Axis::x;
  std::vector<double> thickness_steps;
  std::vector<double> thickness_polynomial;
  std::vector<double> size_steps;
  std::vector<double> size_polynomial;

  bool operator==(const Grading&) const = default;
};

struct Outline {
  std::vector<double> corners_mm;  ///< x and y of each; two are those of a rectangle
  double edge_wall_thickness_mm = 0.0;

  bool operator==(const Outline&) const = default;
};

struct LatticeChanges {
  Defects defects;
  Grading grading;
  double rotation_degrees = 0.0;
  Outline outline;

  bool operator==(const LatticeChanges&) const = default;
};

struct Imperfection {
  double amplitude_mm = 0.0;  ///< of the joints
  std::uint64_t seed = 0;
  double bow_mm = 0.0;  ///< of the middle of the walls

  bool operator==(const Imperfection&) const = default;
};

/// Formulation and integration points of an element (section/section_rule.h).
struct SectionSpec {
  enum class Formulation {
    force_based,        ///< linear moment along the element, as equilibrium requires (E5b)
    displacement_based  ///< linear curvature, as in the paper (Eq. 27, E5a)
  };
  enum class DepthRule {
    full_moment,  ///< exact area, bending stiffness and full plastic moment
    lobatto       ///< as in the paper
  };
  enum class AreaRule {
    constant_volume,  ///< the section area of a wall grows as the wall shortens (E5c)
    constant_area     ///< as in the paper
  };
  Formulation formulation = Formulation::force_based;
  DepthRule depth_rule = DepthRule::full_moment;
  AreaRule area_rule = AreaRule::constant_volume;
  std::optional<int> axial_points;  ///< default: 4 force-based (3 to 5), 2 displacement-based (2 to 5)
  std::optional<int> depth_points;  ///< default: 6 (full-moment: 4, 6 or 10, Lobatto: 4 to 10)
  /// Whether walls shear, elastically (E5i): Timoshenko beams, for walls thicker than a fifth of their length.
  /// Force-based only. The shear modulus follows from material.poissons_ratio.
  bool shear_deformation = false;
  /// kappa: shear area over section area. 5/6 is that of a parabolic shear stress over a rectangle.
  double shear_factor = 5.0 / 6.0;
  /// Whether bending is over the current length, so that moments resist a change of length (E5j): for walls that bend
  /// to a radius below ten times their thickness. Not at constant area.
  bool coupled_bending = false;
  /// Whether joints have the size of their walls and are rigid (scene/rigid_joints.h). Not of frames.
  bool rigid_joints = false;

  [[nodiscard]] int axial_count() const {
    return axial_points.value_or(formulation == Formulation::force_based ? 4 : 2);
  }
  [[nodiscard]] int depth_count() const { return depth_points.value_or(6); }

  bool operator==(const SectionSpec&) const = default;
};

struct ContactSpec {
  enum class Search {
    faces,   ///< by the faces of the lattice, where these are enough (E8c, contact/topology/face_loops.h)
    buckets  ///< in space, as in the paper (section 4.1)
  };
  double friction = 0.0;
  double stiffness_factor = 0.12;  ///< k = m_min max(stiffness_factor / dt_crit^2, ...) (E9)
  double damping_ratio = 0.2;      ///< zeta, fraction of critical damping (E9)
  /// Least speed of approach for which contacts are made (V of E9). The speed of the plate, or that which
  /// velocities, motions, rigid walls and gravity tell (E9a), counts where it is more.
  double impact_speed_m_per_s = 0.0;
  Search search = Search::faces;

  bool operator==(const ContactSpec&) const = default;
};

struct PlatesSpec {
  double friction = 0.0;

  bool operator==(const PlatesSpec&) const = default;
};

/// The two plates, which stand around the lattice where a speed is given or chosen, and the end of the run: at the
/// strain, at the time or at rest, whichever comes first.
struct LoadingSpec {
  static constexpr double kDefaultEndStrain = 0.8;

  enum class Direction { x, y };
  Direction direction = Direction::x;
  /// What stands at the two sides of the lattice across the direction.
  struct Sides {
    enum class Kind { free, rigid, periodic };
    Kind kind = Kind::free;
    double friction = 0.0;            ///< of rigid ones
    bool fixed_width = false;         ///< of periodic ones: they keep their distance
    std::optional<double> period_mm;  ///< of periodic ones of a network; other lattices know theirs
    bool operator==(const Sides&) const = default;
  };
  Sides sides;
  std::optional<double> speed_m_per_s;
  /// Whether the speed is chosen, and lowered during the run, so that the kinetic energy stays below kinetic_share of
  /// the work done (scene/quasi_static.h).
  bool quasi_static = false;
  double kinetic_share = 0.01;
  std::optional<double> end_strain;  ///< default: kDefaultEndStrain, or where the lattice is closed if that is less
  double ramp_strain = 0.0;
  std::optional<double> end_time_s;  ///< default between plates: none
  /// Fraction of the greatest kinetic energy so far, below which the lattice is at rest; 0: the run does not end at
  /// rest (RestWatch in step/rest_watch.h).
  double end_at_rest = 0.0;

  bool operator==(const LoadingSpec&) const = default;
};

struct NumericsSpec {
  double time_step_s = 0.0;  ///< 0: automatic
  double mass_damping_per_s = 0.0;
  /// Fictitious masses for slow crushes (dynamic relaxation, E11b). Masses and rotary inertias are multiplied by
  /// mass_scaling, rotary inertias also by rotary_scaling.
  double mass_scaling = 1.0;
  double rotary_scaling = 1.0;
  /// Length over thickness below which a beam of a frame is a rigid link (scene/rigid_links.h); 0: none is.
  double rigid_link_slenderness = 1.0;
  /// Precision of the fibre stresses; motion, forces and works are always in double precision. Elements of other
  /// numbers of points than the default ones, and force-based elements with hardening, are in double precision whatever
  /// is asked.
  enum class FibrePrecision { single_precision, double_precision };
  FibrePrecision fibre_precision = FibrePrecision::single_precision;
  /// A point of the measured speed-accuracy front; it fills in omitted settings (fidelity.h).
  enum class Fidelity { unspecified, draft, standard, reference };
  Fidelity fidelity = Fidelity::unspecified;
  int threads = 1;

  bool operator==(const NumericsSpec&) const = default;
};

struct OutputSpec {
  int sample_count = 1000;
  int frame_count = 50;

  bool operator==(const OutputSpec&) const = default;
};

struct SceneSpec {
  std::string title;
  std::variant<std::monostate, RegularLattice, VoronoiWalls, NetworkWalls, FrameWalls> lattice;
  LatticeChanges changes;
  LoadsSpec loads;
  Imperfection imperfection;
  Inclusions inclusions;
  std::optional<double> depth_mm;
  std::optional<int> elements_per_wall;  ///< default: that of the fidelity (cellcrush/fidelity.h)
  MaterialSpec material;
  SectionSpec section;
  ContactSpec contact;
  PlatesSpec plates;
  LoadingSpec loading;
  NumericsSpec numerics;
  OutputSpec output;

  bool operator==(const SceneSpec&) const = default;
};

/// One reason why a case cannot run: the field, its value, what is wrong and what to do.
struct Problem {
  std::string field;    ///< path in the case, such as "lattice.hexagon.side_mm"
  std::string value;    ///< value found, as text; empty if the field is missing
  std::string message;  ///< what is wrong, as a sentence
  std::string remedy;   ///< what to do about it, as a sentence
};

using Problems = std::vector<Problem>;

}  // namespace cellcrush
