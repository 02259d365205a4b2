#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/reference/reference_crush.h"

namespace cellcrush::reference {
namespace {

/// A ball that touches a segment.
struct Touch {
  int ball;
  int segment;
  double share;        // s of the foot
  double depth;        // D
  Vector normal;       // from the segment to the ball
  Vector approach;     // velocity of the foot against the ball
  int node;            // the segment's particle nearer to the ball
  double node_depth;   // D_n, of the balls of both
  Vector node_normal;  // from the node to the ball
  double to_the_left;  // of the segment, where the ball is
  double distance;     // of the ball from the foot, against the normal; negative where it has passed the mid-line
};

/// A touch that pushes.
struct Push {
  Touch touch;
  std::optional<Touch> node;  // with the nearest node of the polyline, where the balls of both overlap
  double share = 1.0;         // in the contact of the ball with the polyline (E8b)
  bool has_pair = true;       // whether the viscous force and the friction of the two balls are this touch's
  double normal_force = 0.0;  // f
};

/// The contacts of a step.
class WallContacts {
 public:
  WallContacts(const Lattice& lattice, const Particles& particles, const Motion& motion, std::vector<Pair>& pairs)
      : lattice_(lattice), particles_(particles), motion_(motion), pairs_(pairs) {
    for (const Segment& segment : lattice.segments) {
      thinnest_ = std::min(thinnest_, segment.thickness);
    }
    for (int ball = 0; ball < count_of(lattice.position); ++ball) {
      growth_.push_back(growth_of_ball(lattice, particles, motion, ball));
    }
  }

  void push(ContactForces& forces) {
    std::vector<Push> pushes;
    for (int ball = 0; ball < count_of(lattice_.position); ++ball) {
      std::vector<Touch> touches;
      for (int segment = 0; segment < count_of(lattice_.segments); ++segment) {
        meet(ball, segment, touches);
      }
      choose(touches, pushes);
    }
    for (Push& push : pushes) {
      push_apart(push, forces);
    }
    forces.count += count_of(pushes);
    if (lattice_.contact.friction > 0.0) {
      rub(pushes, forces);
    }
  }

 private:
  template <class T>
  static int count_of(const std::vector<T>& items) {
    return static_cast<int>(items.size());
  }

  [[nodiscard]] std::size_t index(int ball, int segment) const { return ball * lattice_.segments.size() + segment; }

  /// Where the ball stands to the segment (Eq. 41, 42, E8).
  void meet(int ball, int segment, std::vector<Touch>& touches) {
    Pair& pair = pairs_[index(ball, segment)];
    if (pair.reach == 0.0) {
      return;
    }
    const int start = lattice_.segments[segment].start;
    const int end = lattice_.segments[segment].end;
    const Vector span = motion_.position[end] - motion_.position[start];
    const Vector axis = span.normalized();
    const Vector from_start = motion_.position[ball] - motion_.position[start];
    const Vector from_end = motion_.position[ball] - motion_.position[end];
    const bool end_is_nearer = from_end.norm() < from_start.norm();
    const Vector from_node = end_is_nearer ? from_end : from_start;
    const double share = std::clamp(from_start.dot(axis) / span.norm(), 0.0, 1.0);  // Eq. 41a, a capsule
    const bool is_inside = share > 0.0 && share < 1.0;
    const double of_end = share_of_end(share);
    const double reach =
        (1.0 - of_end) * reach_at_node(ball, segment, start) + of_end * reach_at_node(ball, segment, end);  // E8d
    const double to_the_left = cross(axis, from_start);
    const double distance = is_inside ? std::abs(to_the_left) : from_node.norm();  // Eq. 42
    const bool touched = pair.side != 0;
    if (!touched && distance >= reach) {
      return;
    }
    if (!touched || !is_inside) {
      pair.side = to_the_left >= 0.0 ? 1 : -1;  // the side of first touch, and of a ball that goes round an end
    }
    const double apart = is_inside ? pair.side * to_the_left : distance;
    const double depth = reach - apart;  // D
    if (depth <= 0.0 || depth >= 2.0 * reach) {
      pair.side = 0;  // it has left, on its own side or on the other
      return;
    }
    const Vector foot_velocity = (1.0 - share) * motion_.velocity[start] + share * motion_.velocity[end];
    const Vector node_normal = from_node.normalized();
    touches.push_back({ball, segment, share, depth, is_inside ? Vector(pair.side * turned_left(axis)) : node_normal,
                       foot_velocity - motion_.velocity[ball], end_is_nearer ? end : start,
                       reach_at_node(ball, segment, end_is_nearer ? end : start) - from_node.norm(), node_normal,
                       to_the_left, apart});
  }

  /// What the end of a segment has of the growth at the foot (E8d).
  [[nodiscard]] static double share_of_end(double share) { return 3.0 * share * share - 2.0 * share * share * share; }

  /// Distance at which the ball and the segment touch with the foot at a node of the segment (E8a, E8d).
  [[nodiscard]] double reach_at_node(int ball, int segment, int node) const {
    const Pair& pair = pairs_[index(ball, segment)];
    return std::min(pair.reach + growth_[ball] + growth_[node], pair.most);
  }

  /// Whether that follows the growth of both balls.
  [[nodiscard]] bool grows_at(int ball, int segment, int node) const {
    return reach_at_node(ball, segment, node) < pairs_[index(ball, segment)].most;
  }

  [[nodiscard]] bool are_joined(int a, int b) const {
    const Segment& one = lattice_.segments[a];
    const Segment& other = lattice_.segments[b];
    return one.start == other.start || one.start == other.end || one.end == other.start || one.end == other.end;
  }

  static bool is_inside(const Touch& touch) { return touch.share > 0.0 && touch.share < 1.0; }

  /// The touches of a ball that push: the deepest of each polyline (E8b). Equally deep ones push alike; the first does
  /// if they meet at a node.
  void choose(const std::vector<Touch>& touches, std::vector<Push>& pushes) const {
    for (std::size_t i = 0; i < touches.size(); ++i) {
      bool is_deepest = true;
      int equals = 1;
      std::optional<Touch> node;
      for (std::size_t j = 0; j < touches.size(); ++j) {
        const bool joined = j == i || are_joined(touches[i].segment, touches[j].segment);
        const double lead = touches[j].depth - touches[i].depth;
        if (joined && j != i && std::abs(lead) <= 1e-6 * thinnest_ && is_inside(touches[i]) && is_inside(touches[j])) {
          ++equals;
        } else if (joined && (lead > 0.0 || (lead == 0.0 && j < i))) {
          is_deepest = false;
        }
        if (joined && touches[j].node_depth > (node ? node->node_depth : 0.0)) {
          node = touches[j];
        }
      }
      if (is_deepest) {
        pushes.push_back({touches[i], node, 1.0 / equals});
      }
    }
  }

  /// Whether a ball lies before a node, beyond the ends of all segments there that do not end at the ball.
  [[nodiscard]] bool lies_before(int ball, int node) const {
    const Vector away = motion_.position[ball] - motion_.position[node];
    for (const Segment& segment : lattice_.segments) {
      const int other = segment.start == node ? segment.end : segment.start;
      if ((segment.start == node || segment.end == node) && other != ball &&
          (motion_.position[other] - motion_.position[node]).dot(away) > 0.0) {
        return false;
      }
    }
    return true;
  }

  /// Overlap that bounds the viscous force and friction of a push. Two balls find each other: of their pair each touch
  /// takes half, or one takes all.
  double net_depth(Push& push) const {
    const Touch& touch = push.touch;
    if (touch.share > 0.0 && touch.share < 1.0) {
      const bool is_shared = push.node && !lies_before(push.node->node, touch.ball);
      return touch.depth - (is_shared ? 0.5 * push.node->node_depth * touch.normal.dot(push.node->node_normal) : 0.0);
    }
    push.has_pair = touch.ball < touch.node && lies_before(touch.node, touch.ball);
    return touch.depth;
  }

  /// Adds a force on the ball, and its reaction on the segment by the lever rule.
  void add(const Touch& touch, const Vector& force, std::vector<Vector>& forces) const {
    const Segment& segment = lattice_.segments[touch.segment];
    forces[touch.ball] += force;
    forces[segment.start] -= (1.0 - touch.share) * force;
    forces[segment.end] -= touch.share * force;
  }

  /// Forces of a touch by what its reach is a function of (E8d): the lengths of elements, and the place of the foot.
  void push_by_reach(const Touch& touch, double share, double force, ContactForces& forces) const {
    const int start = lattice_.segments[touch.segment].start;
    const int end = lattice_.segments[touch.segment].end;
    for (const auto& [node, of_node] :
         {std::pair(start, 1.0 - share_of_end(share)), std::pair(end, share_of_end(share))}) {
      if (grows_at(touch.ball, touch.segment, node)) {
        push_elements_apart(lattice_, particles_, motion_, touch.ball, of_node * force, forces);
        push_elements_apart(lattice_, particles_, motion_, node, of_node * force, forces);
      }
    }
    if (share > 0.0 && share < 1.0) {
      const Vector span = motion_.position[end] - motion_.position[start];
      const double taper = (6.0 * share - 6.0 * share * share) * (reach_at_node(touch.ball, touch.segment, end) -
                                                                  reach_at_node(touch.ball, touch.segment, start));
      const Vector along = force * taper / span.norm() * span.normalized();
      const Vector couple = force * taper * touch.to_the_left / span.squaredNorm() * turned_left(span.normalized());
      forces.elastic[touch.ball] -= along;
      forces.elastic[start] += (1.0 - share) * along + couple;
      forces.elastic[end] += share * along - couple;
    }
  }

  /// Normal force (Eq. 43, E8b, E9).
  void push_apart(Push& push, ContactForces& forces) const {
    const Touch& touch = push.touch;
    const double k = push.share * lattice_.contact.stiffness;
    add(touch, k * touch.depth * touch.normal, forces.elastic);
    forces.stored += k * touch.depth * touch.depth / 2.0;  // E8b
    push_by_reach(touch, touch.share, k * touch.depth, forces);
    if (push.node) {
      // The gradient of -k D_n^2 / 4.
      const Vector force = k * push.node->node_depth / 2.0 * push.node->node_normal;
      forces.elastic[touch.ball] -= force;
      forces.elastic[push.node->node] += force;
      const double share_of_node = push.node->node == lattice_.segments[push.node->segment].end ? 1.0 : 0.0;
      push_by_reach(*push.node, share_of_node, -k * push.node->node_depth / 2.0, forces);
      forces.stored -= k * push.node->node_depth * push.node->node_depth / 4.0;  // E8b
    }
    const double net_elastic = k * net_depth(push);
    if (push.has_pair) {
      const Segment& segment = lattice_.segments[touch.segment];
      const double s = touch.share;
      const double inverse_mass = 1.0 / particles_.mass[touch.ball] +
                                  (1.0 - s) * (1.0 - s) / particles_.mass[segment.start] +
                                  s * s / particles_.mass[segment.end];  // E9
      const double viscous =
          push.share * viscous_force(lattice_.contact.stiffness, lattice_.contact.damping_ratio, inverse_mass,
                                     touch.normal.dot(touch.approach), net_elastic / push.share);
      add(touch, viscous * touch.normal, forces.viscous);
      push.normal_force = net_elastic + viscous;
    }
  }

  /// Friction of a touch of the ball in the step before that carries none now and whose segment `follows`.
  template <class Follows>
  [[nodiscard]] std::optional<double> handed_over(int ball, const Follows& follows) const {
    for (int segment = 0; segment < count_of(lattice_.segments); ++segment) {
      const Pair& before = before_[index(ball, segment)];
      if (before.rubs && !pairs_[index(ball, segment)].rubs && follows(segment)) {
        return before.friction;
      }
    }
    return std::nullopt;
  }

  /// Friction with which a push begins: its own of the step before; or that of a neighbour from which the ball slid on;
  /// or that of the node's ball on the segments that end at this ball.
  [[nodiscard]] double friction_before(const Push& push) const {
    const int ball = push.touch.ball;
    const int segment = push.touch.segment;
    const Pair& own = before_[index(ball, segment)];
    if (own.rubs) {
      return own.friction;
    }
    const auto of_neighbour = handed_over(ball, [&](int other) { return are_joined(other, segment); });
    if (of_neighbour.value_or(0.0) != 0.0 || !push.node) {
      return of_neighbour.value_or(0.0);
    }
    const auto ends_at_ball = [&](int other) {
      return lattice_.segments[other].start == ball || lattice_.segments[other].end == ball;
    };
    return handed_over(push.node->node, ends_at_ball).value_or(0.0);
  }

  /// How far the surfaces of a touch are from the ball and from the foot, and with which segments they turn (E9d).
  [[nodiscard]] std::pair<Rim, Rim> rims_of(const Touch& touch) const {
    const Segment& segment = lattice_.segments[touch.segment];
    const double of_end = share_of_end(touch.share);
    const double radius = particles_.radius[touch.ball] + growth_[touch.ball];
    const double half_thickness =
        segment.thickness / 2.0 + (1.0 - of_end) * growth_[segment.start] + of_end * growth_[segment.end];
    const double ball_arm = touch.distance / (1.0 + half_thickness / radius);
    const double segment_arm = touch.distance / (1.0 + radius / half_thickness);
    return {{lattice_.segments_at(touch.ball), ball_arm},
            {is_inside(touch) ? std::vector<int>{touch.segment} : lattice_.segments_at(touch.node), segment_arm}};
  }

  void rub(const std::vector<Push>& pushes, ContactForces& forces) {
    before_ = pairs_;
    for (Pair& pair : pairs_) {
      pair.rubs = false;
      pair.friction = 0.0;
    }
    for (const Push& push : pushes) {
      pairs_[index(push.touch.ball, push.touch.segment)].rubs = push.has_pair;
    }
    for (const Push& push : pushes) {
      const Touch& touch = push.touch;
      const Vector tangent = turned_right(touch.normal);
      const auto [of_ball, of_segment] = rims_of(touch);
      const double slide = of_ball.speed(lattice_, motion_) + of_segment.speed(lattice_, motion_);
      const double slip = lattice_.time_step * (slide - tangent.dot(touch.approach));  // Eq. 44, E9d, of the ball
      const double stiffness =
          lattice_.contact.stiffness /
          std::max(of_ball.leverage(lattice_, motion_) + of_segment.leverage(lattice_, motion_), 1.0);
      const double friction =
          friction_after(friction_before(push), stiffness, slip, lattice_.contact.friction * push.normal_force);
      pairs_[index(touch.ball, touch.segment)].friction = friction;
      add(touch, friction * tangent, forces.friction);
      of_ball.turn(lattice_, motion_, friction, forces.friction);
      of_segment.turn(lattice_, motion_, friction, forces.friction);
    }
  }

  const Lattice& lattice_;
  const Particles& particles_;
  const Motion& motion_;
  std::vector<Pair>& pairs_;
  double thinnest_ = std::numeric_limits<double>::infinity();
  std::vector<double> growth_;  // of each ball
  std::vector<Pair> before_;    // with the friction of the step before
};

/// min(R + h/2, 0.4 w), with the shortest path w along the undeformed walls to the nearer end of the segment.
void find_reaches(const Lattice& lattice, const Particles& particles, int ball, Pair* pairs) {
  std::vector<double> path(lattice.position.size(), std::numeric_limits<double>::infinity());
  path[ball] = 0.0;
  for (bool is_shorter = true; is_shorter;) {
    is_shorter = false;
    for (const Segment& segment : lattice.segments) {
      const double length = (lattice.position[segment.end] - lattice.position[segment.start]).norm();
      for (const auto& [from, to] : {std::pair(segment.start, segment.end), std::pair(segment.end, segment.start)}) {
        is_shorter = is_shorter || path[from] + length < path[to];
        path[to] = std::min(path[to], path[from] + length);
      }
    }
  }
  for (std::size_t e = 0; e < lattice.segments.size(); ++e) {
    const Segment& segment = lattice.segments[e];
    if (segment.start != ball && segment.end != ball) {
      const double capsule = particles.radius[ball] + segment.thickness / 2.0;  // E8
      pairs[e].most = 0.4 * std::min(path[segment.start], path[segment.end]);
      pairs[e].reach = std::min(capsule, pairs[e].most);
    }
  }
}

}  // namespace

double growth_of_ball(const Lattice& lattice, const Particles& particles, const Motion& motion, int ball) {
  double growth = 0.0;
  for (const int e : particles.grown_with[ball]) {
    growth += thickening_of(lattice, e, motion.position).growth / 2.0;
  }
  return growth;
}

void push_elements_apart(const Lattice& lattice, const Particles& particles, const Motion& motion, int ball,
                         double force, ContactForces& forces) {
  for (const int e : particles.grown_with[ball]) {
    const Segment& ends = lattice.segments[e];
    const Vector axis = (motion.position[ends.end] - motion.position[ends.start]).normalized();
    const Vector on_end = -force / 2.0 * thickening_of(lattice, e, motion.position).slope * axis;
    forces.elastic[ends.end] += on_end;
    forces.elastic[ends.start] -= on_end;
  }
}

std::vector<Pair> no_contact(const Lattice& lattice, const Particles& particles) {
  const std::size_t balls = lattice.position.size();
  std::vector<Pair> pairs(balls * lattice.segments.size());
  for (std::size_t ball = 0; ball < balls; ++ball) {
    find_reaches(lattice, particles, static_cast<int>(ball), &pairs[ball * lattice.segments.size()]);
  }
  return pairs;
}

void push_walls(const Lattice& lattice, const Particles& particles, const Motion& motion, std::vector<Pair>& pairs,
                ContactForces& forces) {
  WallContacts(lattice, particles, motion, pairs).push(forces);
}

}  // namespace cellcrush::reference
