#include "push/half_planes.h"

#include <algorithm>
#include <utility>

#include "contact/thickening.h"
#include "push/face_forces.h"

namespace cellcrush {
namespace {

/// Depth to which a ball may stand in a half plane at first, as a fraction of its radius: where it is placed on an
/// oblique one, it does so by round-off.
constexpr double kRoundedDepth = 1e-6;

std::string path_of(std::size_t wall) { return "loading.rigid_walls[" + std::to_string(wall) + "]"; }

const Pusher& kind_of(const LoadsSpec::RigidWall& wall) {
  return **std::ranges::find_if(pushers(),
                                [&](const Pusher* kind) { return kind->takes != nullptr && kind->takes(wall); });
}

void press(const Scene& scene, State& state, std::size_t wall, int first, int end, ContactSums& sums) {
  const RigidWall& of = scene.rigid_walls[wall];
  const RigidWallMotion& motion = state.rigid_wall_motion[wall];
  const Face face = {of.point + motion.travel * of.normal,
                     of.normal,
                     of.tangent(),
                     motion.speed,
                     scene.contact.stiffness,
                     of.friction,
                     of.friction > 0.0 ? &state.rigid_wall_friction[wall * scene.particle_count()] : nullptr,
                     !state.radius_growth.empty()};
  RigidWallForce& of_wall = sums.rigid_walls[wall];
  for (int particle = first; particle < end; ++particle) {
    const double radius = radius_now(scene, state, particle);
    const bool rubbed = face.friction_of != nullptr && face.friction_of[particle] != 0.0;
    if (face.distance_of(state.position[particle]) < radius || rubbed) {
      const FaceForce force = push_by_face(scene, state, face, particle, radius);
      of_wall.normal.elastic += force.elastic;
      of_wall.normal.viscous += force.viscous;
      of_wall.tangential += force.tangential;
      sums.walls.stored += force.stored;
    }
  }
}

}  // namespace

void check_half_planes(const LoadsSpec& loads, FieldChecker& check) {
  for (std::size_t i = 0; i < loads.rigid_walls.size(); ++i) {
    const LoadsSpec::RigidWall& wall = loads.rigid_walls[i];
    const std::string path = path_of(i) + ".";
    check.within_limits(path + "x_mm", wall.x_mm);
    check.within_limits(path + "y_mm", wall.y_mm);
    check.within_limits(path + "normal_x", wall.normal_x);
    check.within_limits(path + "normal_y", wall.normal_y);
    check.within_limits(path + "friction", wall.friction);
    if (wall.normal_x == 0.0 && wall.normal_y == 0.0) {
      check.add(path + "normal_x", "0", "and normal_y give no direction.",
                "Give the direction out of the wall, towards the lattice.");
    }
    if (!wall.points.empty()) {
      check.is_function_of_time(path + "displacement_mm", wall.points);
    }
    if (const Pusher& kind = kind_of(wall); kind.check != nullptr) {
      kind.check(path, wall, check);
    }
  }
}

void attach_half_planes(const LoadsSpec& loads, Scene& scene) {
  for (const LoadsSpec::RigidWall& wall : loads.rigid_walls) {
    const LoadsSpec::TimeFunction still = {{0.0, 0.0}};
    const Pusher& kind = kind_of(wall);
    RigidWall& added = scene.rigid_walls.emplace_back();
    added.kind = &kind;
    added.point = Vector2(wall.x_mm, wall.y_mm);
    added.normal = Vector2(wall.normal_x, wall.normal_y).stableNormalized();
    added.friction = wall.friction;
    added.motion = {wall.points.empty() ? still : wall.points};
    if (kind.fill != nullptr) {
      kind.fill(wall, added);
    }
  }
}

Problems find_walls_in_half_planes(const Scene& scene, std::size_t nodes) {
  FieldChecker check;
  for (std::size_t w = 0; w < scene.rigid_walls.size(); ++w) {
    const RigidWall& wall = scene.rigid_walls[w];
    std::size_t deepest = 0;
    double most = 0.0;
    for (std::size_t i = 0; i < scene.particle_count(); ++i) {
      const double height = wall.normal.dot(scene.position[i] - wall.point) - wall.motion.value_at(0.0);
      const double depth = scene.radius[i] - height;
      if (depth > kRoundedDepth * scene.radius[i] && depth > most) {
        most = depth;
        deepest = i;
      }
    }
    if (most > 0.0) {
      const Vector2& place = scene.position[deepest];
      check.add(path_of(w), to_text(most) + " mm",
                "is the depth to which the walls at " +
                    (deepest < nodes ? "lattice.frame.nodes[" + std::to_string(deepest) + "]"
                                     : "(" + to_text(place.x()) + ", " + to_text(place.y()) + ") mm") +
                    " stand in it at time 0, half of their thickness included.",
                "Move the rigid wall back by at least that much, or turn its normal towards the lattice.");
    }
  }
  return check.take();
}

void place_half_planes(const Scene& scene, State& state) {
  const std::size_t count = scene.rigid_walls.size();
  if (std::ranges::any_of(scene.rigid_walls, [](const RigidWall& wall) { return wall.friction > 0.0; })) {
    state.friction_force.assign(scene.particle_count(), Vector2::Zero());
    state.rigid_wall_friction.assign(count * scene.particle_count(), 0.0);
  }
  state.rigid_wall_force.resize(count);
  state.rigid_wall_impulse.resize(count);
  state.rigid_wall_motion.resize(count);
}

void press_half_planes(const Scene& scene, State& state, const Pusher& kind, const PressedBand& on, ContactSums& sums) {
  const LatticeBand& band = on.band;
  for (const auto& [first, end] :
       {std::pair(band.first_joint, band.end_joint), std::pair(band.first_inner, band.end_inner)}) {
    visit_half_planes(scene, kind,
                      [&](std::size_t wall, const RigidWall&) { press(scene, state, wall, first, end, sums); });
  }
}

void add_impulse(const Scene& scene, State& state, std::size_t wall) {
  const RigidWallForce& force = state.rigid_wall_force[wall];
  state.rigid_wall_impulse[wall].normal += scene.schedule.time_step * force.normal.total();
  state.rigid_wall_impulse[wall].tangential += scene.schedule.time_step * force.tangential;
}

std::string count_words(const Scene& scene, const Pusher& kind) {
  const auto count = std::ranges::count(scene.rigid_walls, &kind, &RigidWall::kind);
  return count == 0 ? "" : std::to_string(count) + (count == 1 ? " half plane" : " half planes");
}

std::string friction_words(const Scene& scene, const Pusher& kind) {
  double friction = 0.0;
  visit_half_planes(scene, kind,
                    [&](std::size_t, const RigidWall& wall) { friction = std::max(friction, wall.friction); });
  return "unilateral, not meshed, " +
         (friction > 0.0 ? "Coulomb friction, coefficient up to " + to_text(friction) + "." : "frictionless.");
}

}  // namespace cellcrush
