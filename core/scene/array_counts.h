#pragma once

#include <array>
#include <cstddef>

#include "cellcrush/array_shape.h"
#include "cellcrush/scene.h"

namespace cellcrush {

/// How many entries the arrays of a run have, by their shapes.
class ArrayCounts {
 public:
  unsigned has = kAlways;  ///< of Needs

  std::size_t& operator[](Per per) { return counts_[static_cast<std::size_t>(per)]; }
  std::size_t operator[](Per per) const { return counts_[static_cast<std::size_t>(per)]; }

  [[nodiscard]] std::size_t entries_of(const Shape& shape) const {
    return (shape.needs & ~has) == 0 ? static_cast<std::size_t>(shape.times) * (*this)[shape.per] : 0;
  }

 private:
  std::array<std::size_t, kPerCount> counts_{};
};

/// Of the arrays that come with the mesh. REQUIRES: a scene as build_mesh leaves it, or a complete one.
ArrayCounts count_mesh(const Scene& scene);

/// Adds what contact and plates bring. Arrays of faces are not among it.
void add_contact(const ContactLaw& contact, const Plates& plates, ArrayCounts& counts);

/// Adds the faces of a mesh by which contacts are searched, before they are traced: by Euler's formula, with a particle
/// at most as often among the members of groups as it is a corner.
void add_expected_faces(ArrayCounts& counts);

/// Of all arrays of a scene. Candidates and touches are not among it.
ArrayCounts counts_of(const Scene& scene);

}  // namespace cellcrush
