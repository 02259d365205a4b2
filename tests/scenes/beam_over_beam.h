#pragma once

#include "cellcrush/scene_spec.h"

namespace cellcrush::scenes {

/// A short beam that lies flat over a long one that is held at both ends, 0.01 mm beyond touch: each of its two balls
/// meets the wall like a mass on a spring, and no beam bends. All beams are 1 mm thick, elastic, one element long;
/// contact is without damping. The short beam has the nodes 2 and 3; it flies down at `speed_m_per_s` under
/// `gravity_m_per_s2`.
SceneSpec beam_over_beam(double speed_m_per_s, double gravity_m_per_s2);

}  // namespace cellcrush::scenes
