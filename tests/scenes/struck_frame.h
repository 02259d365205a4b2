#pragma once

#include <memory>

#include "cellcrush/scene.h"
#include "cellcrush/scene_spec.h"
#include "cellcrush/vector.h"

namespace cellcrush::scenes {

/// Another description of the same problem. Mechanics does not depend on it.
struct View {
  double angle = 0.0;          ///< rad, by which everything is turned, after the mirror
  bool mirrored = false;       ///< x becomes -x
  Vector2 boost = {0.0, 0.0};  ///< mm/s, added to every velocity, that of the supports too
  double length = 1.0;         ///< factors of the units: all quantities follow by their dimensions
  double stress = 1.0;
  double time = 1.0;
  bool renumbered = false;  ///< nodes in reverse, beams shuffled, every other beam from its end to its start

  /// A vector of the problem as this view has it, without a change of units.
  [[nodiscard]] Vector2 turned(const Vector2& vector) const;
  /// The number of a node in this view.
  [[nodiscard]] int node(int number) const;
};

/// A plastic frame with two legs, whose top is pushed down and aside while a free bar flies into a leg: beams of odd
/// and even numbers of elements, contact with friction and damping, mixed hardening, gravity, a load, a moment, a line
/// load and an attached mass. It ends after `kEnd` s.
struct StruckFrame {
  static constexpr int kNodes = 8;
  static constexpr double kHeight = 45.0;  // mm
  static constexpr double kEnd = 8e-4;     // s, before a change of units

  static SceneSpec spec(const View& view);
  /// Built from the spec.
  static std::shared_ptr<Scene> scene(const View& view);
};

}  // namespace cellcrush::scenes
