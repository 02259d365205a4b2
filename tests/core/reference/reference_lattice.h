#pragma once

#include <vector>

#include "core/reference/plane.h"
#include "core/reference/reference_element.h"

namespace cellcrush::reference {

/// A segment of the mid-lines, with its round ends a capsule. An element's, or a wall's of a rigid body.
struct Segment {
  int start = 0;  ///< particle
  int end = 0;    ///< particle
  double thickness = 0.0;
  Material material;
  bool in_pair = false;  ///< solved with its neighbour (E5b)
};

/// Penalty contact between walls (Eq. 43-47, E9).
struct ContactData {
  double stiffness = 0.0;      ///< k, N/mm
  double damping_ratio = 0.0;  ///< zeta
  double friction = 0.0;       ///< mu
};

/// Plates at the low and the high end of an axis; that at the low end moves.
struct PlateData {
  int axis = 0;  ///< 0: x, 1: y
  double impact_face = 0.0;
  double support_face = 0.0;
  double speed = 0.0;
  double ramp_time = 0.0;  ///< s in which the speed rises
  double stiffness = 0.0;
  double friction = 0.0;
};

/// Particles that move as one body (E13).
struct BodyData {
  int first = 0;  ///< particle
  int end = 0;
};

/// A lattice between two plates. Units mm, tonne, s, N, MPa.
struct Lattice {
  std::vector<Vector> position;
  std::vector<Segment> segments;  ///< those of rigid bodies last
  int element_count = 0;          ///< segments that are elements
  /// The elements of each wall between two joints, one after another: each ends where the next one starts.
  std::vector<std::vector<int>> walls;
  std::vector<BodyData> bodies;
  ElementRule rule;
  double depth = 0.0;
  ContactData contact;
  PlateData plates;
  double mass_damping = 0.0;  ///< alpha of E2
  double time_step = 0.0;

  /// Those that end at a particle.
  [[nodiscard]] std::vector<int> segments_at(int particle) const;
};

/// Particles' masses and balls.
struct Particles {
  std::vector<double> mass;
  std::vector<double> inertia;
  std::vector<double> radius;
  std::vector<std::vector<int>> grown_with;
};
Particles lump(const Lattice& lattice);

ElementData element_data_of(const Lattice& lattice, int segment);

/// What half of the thickness of a segment has grown by (E5f), with its nodes at these positions.
Thickening thickening_of(const Lattice& lattice, int segment, const std::vector<Vector>& position);

/// Of each ball, the elements with which it grows, by the mean of both: those of a particle inside a wall, or none.
std::vector<std::vector<int>> grown_with(const Lattice& lattice);

}  // namespace cellcrush::reference
