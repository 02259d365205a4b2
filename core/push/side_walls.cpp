// Half planes that stand still at the two sides of the lattice across the crush (E9h).
#include <algorithm>

#include "push/half_planes.h"

namespace cellcrush {
namespace {

/// Those of the list of a case are of other kinds.
bool takes_none(const LoadsSpec::RigidWall& /*wall*/) { return false; }

RigidWallMotion start_still(const Scene& /*scene*/, const RigidWall& /*wall*/) { return {}; }

RigidWallMotion stay_still(const Scene& /*scene*/, const State& /*state*/, std::size_t /*wall*/) { return {}; }

}  // namespace

extern const HalfPlaneKind kSideWalls = {.plural = "Side walls",
                                         .takes = takes_none,
                                         .fields = {},
                                         .misfit = {},
                                         .remedy = {},
                                         .check = nullptr,
                                         .fill = nullptr,
                                         .start = start_still,
                                         .move = stay_still,
                                         .note =
                                             " They stand at the sides of the lattice and suppress its strain "
                                             "across the crush, so that no Poisson's ratio shows."};

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
    wall.point = outermost_along(scene, wall.normal) * wall.normal;
  }
}

std::span<const RigidWall> side_walls_of(const Scene& scene) {
  const auto first = std::ranges::find(scene.rigid_walls, &kSideWalls, &RigidWall::kind);
  return std::span(scene.rigid_walls).subspan(static_cast<std::size_t>(first - scene.rigid_walls.begin()));
}

}  // namespace cellcrush
