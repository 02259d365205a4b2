#pragma once

#include <memory>
#include <optional>

#include "cellcrush/scene.h"
#include "cellcrush/simulation.h"

namespace cellcrush {

/// A frame with what acts on it and its end, in one list.
struct FrameLattice : FrameWalls, LoadsSpec {
  std::optional<double> end_time_s = std::nullopt;
};

namespace scenes {

inline constexpr double kDensity = 2700.0;  ///< kg/m^3, of aluminium

/// Gives a spec the walls, loads and end of a frame.
void put_frame(const FrameLattice& frame, SceneSpec& spec);

/// A scene whose spec has no problems; fails the test with their texts when it has.
std::shared_ptr<Scene> build(const SceneSpec& spec);

/// A beam of a frame, of the case's material.
FrameLattice::Beam beam(int start, int end, double thickness_mm, int elements);

/// A case of an explicit frame of elastic aluminium beams, 1 mm deep, that ends after a second unless the frame says
/// when.
SceneSpec elastic_frame(FrameLattice frame);

/// A cantilever along x, clamped at its left end, elastic, without contact: EI = 200000/12 N mm^2, L = 300 mm, h = 1
/// mm, so that EA L^2 / EI = 1.08e6. Its free end is node 1. Mass damping is twice the first natural frequency.
struct Cantilever {
  static constexpr double kLength = 300.0;
  static constexpr double kStiffness = 200000.0 / 12.0;
  static double first_frequency();

  /// Load on the free end rises linearly to `value` over `rise_time` and stays.
  static SceneSpec spec(int elements, FrameLattice::Component component, double value, double rise_time,
                        double end_time);
};

/// A specimen of the hexagons of Type I, crushed along x at 100 m/s.
SceneSpec hexagon_specimen(int columns, int rows);

/// Small velocities in all directions for every particle, the same ones each time: what no symmetry hides from.
void stir(Scene& scene, double speed);

}  // namespace scenes
}  // namespace cellcrush
