#pragma once

#include "cellcrush/sample.h"
#include "cellcrush/scene_spec.h"

namespace cellcrush::scenes {

/// An elastic bar that flies along its axis, -x, at a rigid wall.
struct FallingBar {
  static constexpr double kLength = 100.0;  // mm
  static constexpr double kThickness = 0.5;
  static constexpr double kGap = 0.001;     // mm
  static constexpr double kSpeed = 1000.0;  // mm / s
  static double wave_speed();               ///< c, mm / s
  static double duration();                 ///< 2 L / c, s
  static double meeting();                  ///< s, when the bar comes to the wall
  static double force();                    ///< V E A / c, N
  static double momentum();                 ///< before, N s

  static SceneSpec spec(int elements);
};

/// A short beam that lies flat on a rigid wall inclined by an angle, under gravity along -y.
struct SlopedBlock {
  static constexpr double kFriction = 0.3;
  static constexpr double kGravity = 1e6;  // mm/s^2: short ways
  static constexpr double kLength = 10.0;  // mm
  static constexpr double kThickness = 1.0;

  explicit SlopedBlock(double incline) : incline_(incline) {}

  [[nodiscard]] SceneSpec spec(double end_time) const;
  [[nodiscard]] double way(const Sample& sample) const;  ///< down the slope, mm
  [[nodiscard]] double weight_across() const;            ///< N
  [[nodiscard]] double weight_along() const;             ///< N
  [[nodiscard]] double acceleration() const;             ///< g (sin - mu cos), mm/s^2

 private:
  double incline_;
};

/// A square frame that flies obliquely, with gravity, at a rigid wall which moves against it and rubs. Corners yield.
/// Everything is turned by an angle; its corners are watched.
struct TossedFrame {
  static constexpr double kSide = 20.0;         // mm
  static constexpr double kWallSpeed = 3000.0;  // mm/s

  static SceneSpec spec(double angle, double yield_stress_mpa = 100.0);
};

/// Of the walls alone.
double mass_in_grams(const SceneSpec& spec);

/// A free lattice of hexagons that a mass runs into from above.
SceneSpec struck_hexagons(double mass_g, double speed_m_per_s);

/// A mass, twice that of the hexagons on the ground which it runs into, comes to rest on them under gravity.
SceneSpec stopped_mass();

}  // namespace cellcrush::scenes
