#pragma once

#include <cstdint>

#include "cellcrush/vector.h"

namespace cellcrush {

/// Plastic strain of a fibre, shortening taken from stretching.
struct NetPlasticStrain {
  double net = 0.0;
  double accumulated = 0.0;  ///< what the law has accumulated by then (FibreHistory::plastic_strain)
};

/// A wall that has broken off its joint, or in two (E6g). Its end became a particle of its own. Break k made particle
/// N + k of outputs, N the particles before any break: element `element` now ends there instead.
struct Break {
  std::int64_t step = 0;            ///< at whose end it broke
  double time = 0.0;                ///< s
  Vector2 place = Vector2::Zero();  ///< mm
  Vector2 force = Vector2::Zero();  ///< N, from the joint on the end while it is released (fracture/release.h)
  double moment = 0.0;              ///< N mm, the same
  double levelling = 0.0;           ///< N mm, on both
  double released = 0.0;            ///< N mm, work against these
  double plastic = 0.0;             ///< N mm, plastic work of the section that broke
  int element = 0;                  ///< which ends there
  int at_end = 0;                   ///< 1: its end, 0: its start
  int wall = 0;                     ///< by its number (MeshView::element_wall)
  int particle = 0;                 ///< of outputs, from which it broke
};

}  // namespace cellcrush
