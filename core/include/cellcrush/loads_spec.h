#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cellcrush {

/// What acts on the walls besides plates. What names nodes or beams is for a frame.
struct LoadsSpec {
  enum class Component { x, y, rotation };
  /// Of the envelope of the lattice.
  enum class Edge { left, right, bottom, top };

  /// A function of time: (s, value), linear between the points, constant outside.
  using TimeFunction = std::vector<std::pair<double, double>>;

  /// Force in N or moment in N mm.
  struct NodalLoad {
    int node = 0;
    Component component = Component::x;
    TimeFunction points;
    bool operator==(const NodalLoad&) const = default;
  };
  /// Imposed displacement in mm, or rotation in rad, of a node from its undeformed position.
  struct NodalMotion {
    int node = 0;
    Component component = Component::x;
    TimeFunction points;
    bool operator==(const NodalMotion&) const = default;
  };
  /// Load in N per mm of undeformed beam length, in the fixed frame (Eq. 4, E14).
  struct DistributedLoad {
    int beam = 0;
    TimeFunction x_points;  ///< empty: none
    TimeFunction y_points;
    bool operator==(const DistributedLoad&) const = default;
  };
  struct InitialVelocity {
    int node = 0;
    double x_m_per_s = 0.0;
    double y_m_per_s = 0.0;
    double rotation_rad_per_s = 0.0;
    bool operator==(const InitialVelocity&) const = default;
  };

  /// A half plane that pushes on all walls, and moves along its normal (E9f).
  struct RigidWall {
    double x_mm = 0.0;  ///< of a point on its face
    double y_mm = 0.0;
    double normal_x = 0.0;  ///< direction out of the wall, towards the lattice; of any length but 0
    double normal_y = 0.0;
    double friction = 0.0;
    TimeFunction points = {};                ///< displacement along the normal, mm; empty: none is imposed
    std::map<std::string, double> own = {};  ///< numbers that only one kind of it has, by the names of their fields
    std::map<std::string, TimeFunction> functions = {};  ///< the same of functions of time; none is empty
    /// At which it stands, in place of point and normal: its face touches the lattice before loading.
    std::optional<Edge> edge = {};
    bool operator==(const RigidWall&) const = default;
  };

  /// A part of the lattice that is held or moved as one: all that lies beyond a line along an edge (E15a).
  struct Grip {
    using Edge = LoadsSpec::Edge;
    enum class FixedTo { ground, impact_plate, support_plate };
    Edge edge = Edge::left;
    std::optional<double> line_mm;  ///< default: the edge of the envelope
    FixedTo fixed_to = FixedTo::ground;
    TimeFunction x_points = {};  ///< displacement, mm; empty: it stands still
    TimeFunction y_points = {};
    bool operator==(const Grip&) const = default;
  };

  std::vector<NodalLoad> loads;
  std::vector<NodalMotion> motions;
  std::vector<DistributedLoad> distributed_loads;
  std::vector<InitialVelocity> initial_velocities;
  double velocity_x_m_per_s = 0.0;  ///< of all walls at the start
  double velocity_y_m_per_s = 0.0;
  double gravity_x_m_per_s2 = 0.0;
  double gravity_y_m_per_s2 = 0.0;
  std::vector<RigidWall> rigid_walls;
  std::vector<Grip> grips;

  bool operator==(const LoadsSpec&) const = default;
};

/// Axis to which an edge is perpendicular, 0: x, 1: y.
inline int axis_of(LoadsSpec::Edge edge) {
  return edge == LoadsSpec::Edge::left || edge == LoadsSpec::Edge::right ? 0 : 1;
}

/// Whether rigid walls take the part of the plates in a spec that has none: two that face each other, of which one only
/// moves, the impact plate of all measures, if no other two do; or one alone, if it stands at an edge of the lattice.
bool has_crushing_walls(const std::vector<LoadsSpec::RigidWall>& walls);

}  // namespace cellcrush
