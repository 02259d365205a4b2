#include "push/half_planes.h"

#include <algorithm>
#include <array>
#include <utility>

#include "contact/thickening.h"

namespace cellcrush {

extern const HalfPlaneKind kStrikers;
extern const HalfPlaneKind kRigidWalls;
extern const HalfPlaneKind kSideWalls;

namespace {

constexpr std::array kKinds = {&kStrikers, &kRigidWalls, &kSideWalls};

/// Depth to which a ball may stand in a half plane at first, as a fraction of its radius: where it is placed on an
/// oblique one, it does so by round-off.
constexpr double kRoundedDepth = 1e-6;

std::string path_of(std::size_t wall) { return "loading.rigid_walls[" + std::to_string(wall) + "]"; }

const HalfPlaneKind& kind_of(const LoadsSpec::RigidWall& wall) {
  return **std::ranges::find_if(kKinds, [&](const HalfPlaneKind* kind) { return kind->takes(wall); });
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

void place_half_planes(const Scene& scene, State& state) {
  const std::size_t count = scene.rigid_walls.size();
  if (std::ranges::any_of(scene.rigid_walls, [](const RigidWall& wall) { return wall.friction > 0.0; })) {
    state.friction_force.assign(scene.particle_count(), Vector2::Zero());
    state.rigid_wall_friction.assign(count * scene.particle_count(), 0.0);
  }
  state.rigid_wall_force.resize(count);
  state.rigid_wall_impulse.resize(count);
  for (const RigidWall& wall : scene.rigid_walls) {
    state.rigid_wall_motion.push_back(wall.kind->start(scene, wall));
  }
}

void stagger_half_planes(const Scene& scene, State& state) {
  for (std::size_t wall = 0; wall < scene.rigid_walls.size(); ++wall) {
    if (scene.rigid_walls[wall].mass > 0.0) {
      state.rigid_wall_motion[wall].speed -= 0.5 * scene.schedule.time_step * acceleration_of(scene, state, wall);
    }
  }
}

void move_half_planes(const Scene& scene, State& state) {
  for (std::size_t wall = 0; wall < scene.rigid_walls.size(); ++wall) {
    RigidWallMotion& motion = state.rigid_wall_motion[wall];
    const double before = motion.speed;
    motion = scene.rigid_walls[wall].kind->move(scene, state, wall);
    motion.way = 0.5 * scene.schedule.time_step * (before + motion.speed);
  }
}

void press_by_half_planes(const Scene& scene, State& state, const PlateStep& /*plates*/, const PressedBand& on,
                          ContactSums& sums) {
  const LatticeBand& band = on.band;
  for (const auto& [first, end] :
       {std::pair(band.first_joint, band.end_joint), std::pair(band.first_inner, band.end_inner)}) {
    for (std::size_t wall = 0; wall < scene.rigid_walls.size(); ++wall) {
      press(scene, state, wall, first, end, sums);
    }
  }
}

/// The works of the newest forces over a way along the normal, mm; friction does none on the half plane. A mass belongs
/// to what the ledger has: of the forces on it, those of the lattice do not come from outside.
MotionWorks works_over(const Scene& scene, const State& state, std::size_t wall, double way) {
  const RigidWall& of = scene.rigid_walls[wall];
  MotionWorks works = face_works(state.rigid_wall_force[wall].normal, way);
  if (of.mass > 0.0) {
    works.external = of.mass * of.kind->drive(scene, of, state.rigid_wall_motion[wall]) * way;
  }
  return works;
}

void accumulate_half_planes(const Scene& scene, const PlateStep& /*plates*/, State& state) {
  const double step = scene.schedule.time_step;
  for (std::size_t wall = 0; wall < scene.rigid_walls.size(); ++wall) {
    works_over(scene, state, wall, state.rigid_wall_motion[wall].way).accumulate(state.ledger);
    const RigidWallForce& force = state.rigid_wall_force[wall];
    state.rigid_wall_impulse[wall].normal += step * force.normal.total();
    state.rigid_wall_impulse[wall].tangential += step * force.tangential;
  }
}

MotionWorks half_step_works_of_half_planes(const Scene& scene, const State& state) {
  const double step = scene.schedule.time_step;
  MotionWorks works;
  for (std::size_t wall = 0; wall < scene.rigid_walls.size(); ++wall) {
    const double speed = state.rigid_wall_motion[wall].speed;
    works.add(works_over(scene, state, wall, 0.5 * step * speed));
    if (const double mass = scene.rigid_walls[wall].mass; mass > 0.0) {
      works.twice_kinetic += mass * speed * (speed + step * acceleration_of(scene, state, wall));
    }
  }
  return works;
}

void describe_half_planes(const Scene& scene, std::vector<std::string>& lines) {
  for (const HalfPlaneKind* kind : kKinds) {
    int count = 0;
    int moving = 0;
    double friction = 0.0;
    for (const RigidWall& wall : scene.rigid_walls) {
      if (wall.kind == kind) {
        ++count;
        moving += wall.moves() ? 1 : 0;
        friction = std::max(friction, wall.friction);
      }
    }
    if (count > 0) {
      lines.push_back(std::string(kind->plural) + ": " + std::to_string(count) +
                      (count == 1 ? " half plane, " : " half planes, ") + std::to_string(moving) +
                      " of them moving, unilateral, not meshed, " + friction_words(friction, "up to ") +
                      std::string(kind->note));
    }
  }
}

}  // namespace

extern const Pusher kHalfPlanes = {.place = place_half_planes,
                                   .stagger = stagger_half_planes,
                                   .move = move_half_planes,
                                   .press = press_by_half_planes,
                                   .accumulate = accumulate_half_planes,
                                   .half_step_works = half_step_works_of_half_planes,
                                   .describe = describe_half_planes};

double acceleration_of(const Scene& scene, const State& state, std::size_t wall) {
  const RigidWall& of = scene.rigid_walls[wall];
  return of.kind->drive(scene, of, state.rigid_wall_motion[wall]) -
         state.rigid_wall_force[wall].normal.total() / of.mass;
}

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
    kind_of(wall).check(path, wall, check);
  }
}

void attach_half_planes(const LoadsSpec& loads, Scene& scene) {
  for (const LoadsSpec::RigidWall& wall : loads.rigid_walls) {
    const LoadsSpec::TimeFunction still = {{0.0, 0.0}};
    const HalfPlaneKind& kind = kind_of(wall);
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
      const auto node = [&] { return scene.list_order.listed_joint(static_cast<int>(deepest)); };
      check.add(path_of(w), to_text(most) + " mm",
                "is the depth to which the walls at " +
                    (deepest < nodes ? "lattice.frame.nodes[" + std::to_string(node()) + "]"
                                     : "(" + to_text(place.x()) + ", " + to_text(place.y()) + ") mm") +
                    " stand in it at time 0, half of their thickness included.",
                "Move the rigid wall back by at least that much, or turn its normal towards the lattice.");
    }
  }
  return check.take();
}

std::string friction_words(double coefficient, const std::string& before) {
  return coefficient > 0.0 ? "Coulomb friction, coefficient " + before + to_text(coefficient) + "." : "frictionless.";
}

}  // namespace cellcrush
