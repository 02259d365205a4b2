#include "push/half_planes.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "contact/thickening.h"

namespace cellcrush {

extern const HalfPlaneKind kStrikers;
extern const HalfPlaneKind kPacedWalls;
extern const HalfPlaneKind kRigidWalls;
extern const HalfPlaneKind kSideWalls;

namespace {

constexpr std::array kKinds = {&kStrikers, &kPacedWalls, &kRigidWalls, &kSideWalls};

/// Depth to which a ball may stand in a half plane at first, as a fraction of its radius: where it is placed on an
/// oblique one, it does so by round-off.
constexpr double kRoundedDepth = 1e-6;

std::string path_of(std::size_t wall) { return "loading.rigid_walls[" + std::to_string(wall) + "]"; }

const HalfPlaneKind& kind_of(const LoadsSpec::RigidWall& wall) {
  return **std::ranges::find_if(kKinds, [&](const HalfPlaneKind* kind) { return kind->takes(wall); });
}

/// A wall stands at an edge of the lattice, or at a point with a normal.
void check_place(const std::string& path, const LoadsSpec::RigidWall& wall, FieldChecker& check) {
  check.within_limits(path + "x_mm", wall.x_mm);
  check.within_limits(path + "y_mm", wall.y_mm);
  check.within_limits(path + "normal_x", wall.normal_x);
  check.within_limits(path + "normal_y", wall.normal_y);
  const bool has_normal = wall.normal_x != 0.0 || wall.normal_y != 0.0;
  if (wall.edge && (has_normal || wall.x_mm != 0.0 || wall.y_mm != 0.0)) {
    check.add(path + "edge", "", "tells where the wall stands, but a point or a normal is given too.",
              "Remove x_mm, y_mm, normal_x and normal_y, or edge.");
  } else if (!wall.edge && !has_normal) {
    check.add(path + "normal_x", "0", "and normal_y give no direction.",
              "Give the direction out of the wall, towards the lattice, or the edge at which it stands.");
  }
}

/// A kind has fields that others have not.
void check_belongs(const std::string& field, const std::string& value, const HalfPlaneKind& kind, std::string_view name,
                   FieldChecker& check) {
  if (std::ranges::find(kind.fields, name) != kind.fields.end()) return;
  check.add(field, value, std::string(kind.misfit), std::string(kind.remedy));
}

/// Particles that are looked at together.
constexpr int kTile = 64;

/// Whether any of the balls from `first` to `end` may reach the face: none is larger than `reach`.
bool may_reach(const State& state, const Face& face, double reach, int first, int end) {
  const double place = face.normal.dot(face.point) + reach;
  int reaching = 0;  // without a branch, so that the compiler makes vectors of it
  for (int particle = first; particle < end; ++particle) {
    reaching |= static_cast<int>(face.normal.dot(state.position[particle]) < place);
  }
  return reaching != 0;
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
  constexpr double kRounding = 1e-9;  // mm
  const double reach = scene.greatest_radius() + kRounding;
  RigidWallForce& of_wall = sums.rigid_walls[wall];
  for (int tile = first; tile < end; tile += kTile) {
    const int tile_end = std::min(tile + kTile, end);
    if (face.friction_of == nullptr && !may_reach(state, face, reach, tile, tile_end)) continue;
    for (int particle = tile; particle < tile_end; ++particle) {
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
}

void place_half_planes(const Scene& scene, State& state) {
  const std::size_t count = scene.rigid_walls.size();
  if (std::ranges::any_of(scene.rigid_walls, [](const RigidWall& wall) { return wall.friction > 0.0; })) {
    state.friction_force.assign(scene.particle_count(), Vector2::Zero());
    state.rigid_wall_friction.assign(count * scene.particle_count(), 0.0);
  }
  state.rigid_wall_force.resize(count);
  state.rigid_wall_totals.resize(count);
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

/// The works of the newest forces, which are those of a time, over a way along the normal, mm; friction does none on
/// the half plane. A mass belongs to what the ledger has: of the forces on it, those of the lattice do not come from
/// outside.
MotionWorks works_over(const Scene& scene, const State& state, std::size_t wall, double time, double way) {
  const RigidWall& of = scene.rigid_walls[wall];
  MotionWorks works = face_works(state.rigid_wall_force[wall].normal, way);
  if (of.mass > 0.0) {
    works.external = of.mass * of.kind->drive(scene, of, time) * way;
  }
  return works;
}

void accumulate_half_planes(const Scene& scene, const PlateStep& /*plates*/, State& state) {
  const double step = scene.schedule.time_step;
  for (std::size_t wall = 0; wall < scene.rigid_walls.size(); ++wall) {
    const double way = state.rigid_wall_motion[wall].way;
    works_over(scene, state, wall, state.time - step, way).accumulate(state.ledger);
    const RigidWallForce& force = state.rigid_wall_force[wall];
    RigidWallTotals& totals = state.rigid_wall_totals[wall];
    totals.normal += step * force.normal.total();
    totals.tangential += step * force.tangential;
    totals.work += way * force.normal.total();
  }
}

MotionWorks half_step_works_of_half_planes(const Scene& scene, const State& state) {
  const double step = scene.schedule.time_step;
  MotionWorks works;
  for (std::size_t wall = 0; wall < scene.rigid_walls.size(); ++wall) {
    const double speed = state.rigid_wall_motion[wall].speed;
    works.add(works_over(scene, state, wall, state.time, 0.5 * step * speed));
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
  return of.kind->drive(scene, of, state.time) - state.rigid_wall_force[wall].normal.total() / of.mass;
}

Vector2 normal_at(LoadsSpec::Edge edge) {
  using Edge = LoadsSpec::Edge;
  const bool is_low = edge == Edge::left || edge == Edge::bottom;
  return (is_low ? 1.0 : -1.0) * Vector2::Unit(axis_of(edge));
}

double outermost_along(const Scene& scene, const Vector2& direction) {
  double least = scene.position.empty() ? -1.0 : std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < scene.particle_count(); ++i) {
    least = std::min(least, direction.dot(scene.position[i]) - scene.radius[i]);
  }
  return least;
}

void check_half_planes(const SceneSpec& spec, FieldChecker& check) {
  for (std::size_t i = 0; i < spec.loads.rigid_walls.size(); ++i) {
    const LoadsSpec::RigidWall& wall = spec.loads.rigid_walls[i];
    const std::string path = path_of(i) + ".";
    check_place(path, wall, check);
    check.within_limits(path + "friction", wall.friction);
    if (!wall.points.empty()) {
      check.is_function_of_time(path + "displacement_mm", wall.points);
    }
    const HalfPlaneKind& kind = kind_of(wall);
    for (const auto& [name, value] : wall.own) {
      if (check.within_limits(path + name, value)) check_belongs(path + name, to_text(value), kind, name, check);
    }
    for (const auto& [name, points] : wall.functions) {
      check.is_function_of_time(path + name, points);
      check_belongs(path + name, "", kind, name, check);
    }
    if (kind.check != nullptr) kind.check(path, spec, wall, check);
  }
}

void attach_half_planes(const LoadsSpec& loads, const Vector2& extent, Scene& scene) {
  for (const LoadsSpec::RigidWall& wall : loads.rigid_walls) {
    const LoadsSpec::TimeFunction still = {{0.0, 0.0}};
    const HalfPlaneKind& kind = kind_of(wall);
    RigidWall& added = scene.rigid_walls.emplace_back();
    added.kind = &kind;
    added.point = Vector2(wall.x_mm, wall.y_mm);
    added.normal = Vector2(wall.normal_x, wall.normal_y).stableNormalized();
    added.friction = wall.friction;
    added.motion = {wall.points.empty() ? still : wall.points};
    if (wall.edge) {
      added.at_edge = true;
      added.normal = normal_at(*wall.edge);
      added.point = outermost_along(scene, added.normal) * added.normal;
    }
    if (kind.fill != nullptr) {
      kind.fill(wall, {scene.gravity, scene.depth * added.tangent().cwiseAbs().dot(extent)}, added);
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
