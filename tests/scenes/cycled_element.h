#pragma once

#include <functional>

#include "scenes/frames.h"

namespace cellcrush::scenes {

/// One element (1 mm thick, 10 mm long) whose ends are moved to and fro, so that nothing but its fibres is under test.
struct CycledElement {
  static constexpr double kLength = 10.0;  // mm
  static constexpr double kThickness = 1.0;
  static constexpr int kCycles = 6;
  static constexpr double kQuarter = 4e-4;  // s, quarter of a cycle

  /// Goes to +amplitude and -amplitude in turn.
  static FrameLattice::TimeFunction to_and_fro(double amplitude);

  /// The end moves along by that elongation over length: stress over strain of a bar of constant area.
  static SceneSpec stretched(double amplitude, const MaterialSpec& material);

  /// Both ends turn against each other to that curvature, 1/mm: pure bending.
  static SceneSpec bent(double curvature, const MaterialSpec& material, int depth_points = 6);

  /// Calls visit(time, force and moment that the element's end bears) after every step, and before it turn(side) where
  /// the motion has turned.
  static void run(const SceneSpec& spec, const std::function<void(double)>& turn,
                  const std::function<void(double, double, double)>& visit);
};

}  // namespace cellcrush::scenes
