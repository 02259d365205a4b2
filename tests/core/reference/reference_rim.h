#pragma once

#include <vector>

#include "core/reference/reference_contact.h"
#include "core/reference/reference_lattice.h"

namespace cellcrush::reference {

/// A surface on which friction acts (E9d).
struct Rim {
  std::vector<int> segments;  ///< with which it turns
  double arm;                 ///< mm, of friction

  /// Speed at which the surface runs, by its turning to the left, mm/s.
  [[nodiscard]] double speed(const Lattice& lattice, const Motion& motion) const;

  /// Adds the forces by which a friction force (N) turns the surface to the left.
  void turn(const Lattice& lattice, const Motion& motion, double friction, std::vector<Vector>& forces) const;

  /// Twice the square of the arm over the length of the segments.
  [[nodiscard]] double leverage(const Lattice& lattice, const Motion& motion) const;
};

}  // namespace cellcrush::reference
