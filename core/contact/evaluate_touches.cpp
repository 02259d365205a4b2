#include "contact/evaluate_touches.h"

#include "contact/normal_force.h"
#include "contact/wide_touches.h"
#include "simd/target.h"

namespace cellcrush {
namespace {

/// Returns whether the pair has parted.
bool evaluate_touch(const Scene& scene, const State& state, ContactLists& lists, Touches& touches, std::size_t i) {
  const int ball = lists.touching.ball[i];
  const int segment = lists.touching.segment[i];
  const Element& element = scene.elements[segment];
  const Vector2& axis = state.axis[segment];
  const double length = state.length[segment];

  // Where the ball stands.
  const Vector2 from_start = state.position[ball] - state.position[element.start];
  const Vector2 from_end = state.position[ball] - state.position[element.end];
  const bool end_is_nearer = from_end.squaredNorm() < from_start.squaredNorm();
  const Vector2 from_node = end_is_nearer ? from_end : from_start;
  const double node_distance = from_node.norm();
  const double ahead = from_start.dot(axis);
  const bool inside = ahead > 0.0 && ahead < length;
  const double share = inside ? ahead / length : (ahead > 0.0 ? 1.0 : 0.0);
  const double signed_distance = cross(axis, from_start);
  int side = lists.touching.side[i];
  if (side == 0 || !inside) {
    // A ball that goes round an end comes to the other side by right.
    side = signed_distance >= 0.0 ? 1 : -1;
  }
  const Vector2 across = side * normal_of(axis);
  const Vector2 node_normal = node_distance > 0.0 ? Vector2(from_node / node_distance) : across;
  const Vector2 normal = inside ? across : node_normal;

  // How it moves.
  const Vector2 closing =
      (1.0 - share) * state.velocity[element.start] + share * state.velocity[element.end] - state.velocity[ball];
  const double inverse_mass = scene.inverse_mass[ball] +
                              (1.0 - share) * (1.0 - share) * scene.inverse_mass[element.start] +
                              share * share * scene.inverse_mass[element.end];

  const double reach = lists.touching.reach[i];
  const double overlap = reach - (inside ? side * signed_distance : node_distance);
  const double depth = overlap < 2.0 * reach ? overlap : 0.0;  // pressed through and out, it touches no more
  lists.touching.side[i] = depth > 0.0 ? side : 0;
  touches.start[i] = element.start;
  touches.end[i] = element.end;
  touches.share[i] = share;
  touches.depth[i] = depth;
  touches.normal[i] = normal;
  touches.viscous[i] =
      viscous_force(scene.contact.stiffness, scene.contact.damping_ratio, inverse_mass, normal.dot(closing));
  touches.slip[i] = scene.schedule.time_step * side * cross(normal, closing);
  touches.node[i] = end_is_nearer ? element.end : element.start;
  touches.node_depth[i] = node_distance > 0.0 ? reach - node_distance : 0.0;
  touches.node_normal[i] = node_normal;
  return !(depth > 0.0);
}

std::size_t evaluate_touches_plain(const Scene& scene, const State& state, ContactLists& lists, Touches& touches,
                                   std::size_t first, std::size_t end, int* parted) {
  std::size_t count = 0;
  for (std::size_t i = first; i < end; ++i) {
    if (evaluate_touch(scene, state, lists, touches, i)) {
      parted[count++] = static_cast<int>(i);
    }
  }
  return count;
}

}  // namespace

void evaluate_touches(const Scene& scene, const State& state, ContactLists& lists, Touches& touches, std::size_t first,
                      std::size_t end, std::vector<int>& parted) {
  const auto evaluate = use_wide_kernels() ? evaluate_touches_wide : evaluate_touches_plain;
  parted.resize(end - first);
  parted.resize(evaluate(scene, state, lists, touches, first, end, parted.data()));
}

}  // namespace cellcrush
