// Half planes that stand still at the two sides of the lattice across the crush (E9h).
#include <algorithm>
#include <limits>

#include "push/half_planes.h"

namespace cellcrush {
namespace {

/// Those of the list of a case are of other kinds.
bool takes_none(const LoadsSpec::RigidWall& /*wall*/) { return false; }

void check_none(const std::string& /*path*/, const LoadsSpec::RigidWall& /*wall*/, FieldChecker& /*check*/) {}

RigidWallMotion start_still(const Scene& /*scene*/, const RigidWall& /*wall*/) { return {}; }

RigidWallMotion stay_still(const Scene& /*scene*/, const State& /*state*/, std::size_t /*wall*/) { return {}; }

}  // namespace

extern const HalfPlaneKind kSideWalls = {"Side walls",
                                         takes_none,
                                         check_none,
                                         nullptr,
                                         start_still,
                                         stay_still,
                                         nullptr,
                                         " They stand at the sides of the lattice and suppress its strain across the "
                                         "crush, so that no Poisson's ratio shows."};

void attach_side_walls(const LoadingSpec& loading, Scene& scene) {
  if (loading.sides.kind != LoadingSpec::Sides::Kind::rigid) {
    return;
  }
  const int across = loading.direction == LoadingSpec::Direction::x ? 1 : 0;
  for (const double inward : {1.0, -1.0}) {
    RigidWall& wall = scene.rigid_walls.emplace_back();
    wall.kind = &kSideWalls;
    wall.friction = loading.sides.friction;
    wall.normal[across] = inward;
    wall.motion = {{{0.0, 0.0}}};
    double outermost = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < scene.particle_count(); ++i) {
      outermost = std::min(outermost, inward * scene.position[i][across] - scene.radius[i]);
    }
    wall.point[across] = inward * outermost;
  }
}

std::span<const RigidWall> side_walls_of(const Scene& scene) {
  const auto first = std::ranges::find(scene.rigid_walls, &kSideWalls, &RigidWall::kind);
  return std::span(scene.rigid_walls).subspan(static_cast<std::size_t>(first - scene.rigid_walls.begin()));
}

}  // namespace cellcrush
