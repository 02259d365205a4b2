#include "contact/wide_touches.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "contact/wide_touches.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr int kMostLanes = 8;

/// Where the numbers lie that pairs are evaluated from and that are found of them. In one place, so that no store of a
/// number makes the processor look for them again.
struct PairArrays {
  const Element* elements;
  const double* inverse_mass;
  const Vector2* position;
  const Vector2* velocity;
  const Vector2* axis;
  const double* length;
  const int* ball;
  const int* segment;
  const double* reach;
  int* side;
  int* start;
  int* end;
  double* share;
  double* depth;
  Vector2* normal;
  double* viscous;
  double* slip;
  int* node;
  double* node_depth;
  Vector2* node_normal;

  PairArrays(const Scene& scene, const State& state, ContactLists& lists, Touches& touches)
      : elements(scene.elements.data()),
        inverse_mass(scene.inverse_mass.data()),
        position(state.position.data()),
        velocity(state.velocity.data()),
        axis(state.axis.data()),
        length(state.length.data()),
        ball(lists.touching.ball.data()),
        segment(lists.touching.segment.data()),
        reach(lists.touching.reach.data()),
        side(lists.touching.side.data()),
        start(touches.start.data()),
        end(touches.end.data()),
        share(touches.share.data()),
        depth(touches.depth.data()),
        normal(touches.normal.data()),
        viscous(touches.viscous.data()),
        slip(touches.slip.data()),
        node(touches.node.data()),
        node_depth(touches.node_depth.data()),
        node_normal(touches.node_normal.data()) {}
};

/// Notes the particles of the lanes' segments.
template <class D>
HWY_INLINE void note_nodes(D d, const PairArrays& arrays, std::size_t i) {
  for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane) {
    const Element& element = arrays.elements[arrays.segment[i + lane]];
    arrays.start[i + lane] = element.start;
    arrays.end[i + lane] = element.end;
  }
}

template <class D>
HWY_INLINE Points<D> difference(const Points<D>& a, const Points<D>& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y)};
}

template <class D>
HWY_INLINE Points<D> choose(hn::Mask<D> mask, const Points<D>& yes, const Points<D>& no) {
  return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y)};
}

/// How the lanes' particles are and move.
template <class D>
struct LaneParticles {
  Points<D> position;
  Points<D> velocity;
  hn::Vec<D> inverse_mass;
};

template <class D>
HWY_INLINE LaneParticles<D> gather_particles(D d, const PairArrays& arrays, const int* particles) {
#if HWY_TARGET != HWY_SCALAR
  if constexpr (hn::MaxLanes(D()) > 1) {
    // Half by half: so few places are in use at a time that they stay in registers.
    constexpr std::size_t kHalf = hn::MaxLanes(D()) / 2;
    const hn::Half<D> half;
    const auto low_position = load_half(d, arrays.position, particles);
    const auto low_velocity = load_half(d, arrays.velocity, particles);
    const auto low_mass = gather_numbers(half, arrays.inverse_mass, particles);
    const auto high_position = load_half(d, arrays.position, particles + kHalf);
    const auto high_velocity = load_half(d, arrays.velocity, particles + kHalf);
    const auto high_mass = gather_numbers(half, arrays.inverse_mass, particles + kHalf);
    return {part_points(d, low_position, high_position), part_points(d, low_velocity, high_velocity),
            hn::Combine(d, high_mass, low_mass)};
  }
#endif
  if constexpr (hn::MaxLanes(D()) == 1) {
    return {gather_points(d, arrays.position, particles), gather_points(d, arrays.velocity, particles),
            gather_numbers(d, arrays.inverse_mass, particles)};
  }
}

/// The particles of the lanes' pairs, brought together before anything is written: their places are computed once.
template <class D>
struct LanePairs {
  LaneParticles<D> ball;
  LaneParticles<D> start;
  LaneParticles<D> end;
};

/// Where the foot of a ball lies, how deep, its side of the segment, and the normal there.
template <class D>
struct Stand {
  hn::Vec<D> depth;
  hn::Vec<D> share;
  hn::Vec<D> side;  // +1 or -1
  Points<D> normal;
};

template <class D>
HWY_INLINE Stand<D> evaluate_stand(D d, const PairArrays& arrays, const LanePairs<D>& at, std::size_t i) {
  const hn::Rebind<int, D> narrow;
  const auto zero = hn::Zero(d);
  const auto one = hn::Set(d, 1.0);
  const Points<D> axis = gather_points(d, arrays.axis, arrays.segment + i);
  const auto length = gather_numbers(d, arrays.length, arrays.segment + i);
  const Points<D> from_start = difference<D>(at.ball.position, at.start.position);
  const Points<D> from_end = difference<D>(at.ball.position, at.end.position);
  const auto end_is_nearer = hn::Lt(dot(from_end, from_end), dot(from_start, from_start));
  const Points<D> from_node = choose<D>(end_is_nearer, from_end, from_start);
  const auto node_distance = hn::Sqrt(dot(from_node, from_node));
  const auto ahead = dot(from_start, axis);
  const auto is_ahead = hn::Gt(ahead, zero);
  const auto inside = hn::And(is_ahead, hn::Lt(ahead, length));
  const auto at_end = hn::IfThenElse(is_ahead, one, zero);
  const auto share = hn::IfThenElse(inside, hn::Div(ahead, length), at_end);
  const auto signed_distance = cross(axis, from_start);

  // A ball that goes round an end comes to the other side by right.
  const auto before = hn::PromoteTo(d, hn::LoadU(narrow, arrays.side + i));
  const auto now = hn::IfThenElse(hn::Ge(signed_distance, zero), one, hn::Set(d, -1.0));
  const auto side = hn::IfThenElse(hn::And(inside, hn::Ne(before, zero)), before, now);

  const Points<D> across = {hn::Neg(hn::Mul(side, axis.y)), hn::Mul(side, axis.x)};
  const auto apart = hn::Gt(node_distance, zero);
  const auto per_distance = hn::Div(one, node_distance);
  const Points<D> unit = {hn::Mul(from_node.x, per_distance), hn::Mul(from_node.y, per_distance)};
  const Points<D> node_normal = choose<D>(apart, unit, across);
  const auto reach = hn::LoadU(d, arrays.reach + i);
  const auto distance = hn::IfThenElse(inside, hn::Mul(side, signed_distance), node_distance);
  const Points<D> normal = choose<D>(inside, across, node_normal);
  const auto overlap = hn::Sub(reach, distance);
  const auto depth = hn::IfThenElseZero(hn::Lt(overlap, hn::Add(reach, reach)), overlap);
  const auto side_kept = hn::IfThenElseZero(hn::Gt(depth, zero), side);
  hn::StoreU(hn::DemoteTo(narrow, side_kept), narrow, arrays.side + i);
  hn::StoreU(depth, d, arrays.depth + i);
  hn::StoreU(share, d, arrays.share + i);
  store_points(d, normal, arrays.normal + i);
  const auto node = hn::IfThenElse(end_is_nearer, hn::PromoteTo(d, hn::LoadU(narrow, arrays.end + i)),
                                   hn::PromoteTo(d, hn::LoadU(narrow, arrays.start + i)));
  hn::StoreU(hn::DemoteTo(narrow, node), narrow, arrays.node + i);
  hn::StoreU(hn::IfThenElseZero(apart, hn::Sub(reach, node_distance)), d, arrays.node_depth + i);
  store_points(d, node_normal, arrays.node_normal + i);
  return {depth, share, side, normal};
}

template <class D>
HWY_INLINE void evaluate_motion(D d, const Scene& scene, const PairArrays& arrays, const LanePairs<D>& at,
                                const Stand<D>& stand, std::size_t i) {
  const auto to_end = stand.share;
  const auto to_start = hn::Sub(hn::Set(d, 1.0), to_end);
  const Points<D>& start = at.start.velocity;
  const Points<D>& end = at.end.velocity;
  const Points<D>& ball = at.ball.velocity;
  const Points<D> closing = {hn::MulAdd(to_start, start.x, hn::MulSub(to_end, end.x, ball.x)),
                             hn::MulAdd(to_start, start.y, hn::MulSub(to_end, end.y, ball.y))};
  const auto of_nodes = hn::MulAdd(hn::Mul(to_end, to_end), at.end.inverse_mass, at.ball.inverse_mass);
  const auto inverse_mass = hn::MulAdd(hn::Mul(to_start, to_start), at.start.inverse_mass, of_nodes);
  const auto critical = hn::Sqrt(hn::Div(hn::Set(d, scene.contact.stiffness), inverse_mass));
  const auto damping = hn::Mul(hn::Set(d, 2.0 * scene.contact.damping_ratio), critical);
  hn::StoreU(hn::Mul(damping, dot(stand.normal, closing)), d, arrays.viscous + i);
  const auto slide = hn::Mul(stand.side, cross(stand.normal, closing));
  hn::StoreU(hn::Mul(hn::Set(d, scene.schedule.time_step), slide), d, arrays.slip + i);
}

/// Returns the lanes whose pairs have parted.
template <class D>
HWY_INLINE hn::Mask<D> evaluate_pairs(D d, const Scene& scene, const PairArrays& arrays, std::size_t i) {
  note_nodes(d, arrays, i);
  const LanePairs<D> at = {gather_particles(d, arrays, arrays.ball + i), gather_particles(d, arrays, arrays.start + i),
                           gather_particles(d, arrays, arrays.end + i)};
  const Stand<D> stand = evaluate_stand(d, arrays, at, i);
  evaluate_motion(d, scene, arrays, at, stand, i);
  return hn::Not(hn::Gt(stand.depth, hn::Zero(d)));
}

std::size_t evaluate_all(const Scene& scene, const State& state, ContactLists& lists, Touches& touches,
                         std::size_t first, std::size_t end, int* parted) {
  const PairArrays arrays(scene, state, lists, touches);
  const hn::CappedTag<double, kMostLanes> wide;
  const hn::CappedTag<double, 1> one;
  std::size_t parted_count = 0;
  std::size_t i = first;
  for (; i + hn::Lanes(wide) <= end; i += hn::Lanes(wide)) {
    const auto apart = evaluate_pairs(wide, scene, arrays, i);
    parted_count += write_set_lanes(wide, apart, i, parted + parted_count);
  }
  for (; i < end; ++i) {
    const auto apart = evaluate_pairs(one, scene, arrays, i);
    parted_count += write_set_lanes(one, apart, i, parted + parted_count);
  }
  return parted_count;
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cellcrush {

HWY_EXPORT(evaluate_all);

std::size_t evaluate_touches_wide(const Scene& scene, const State& state, ContactLists& lists, Touches& touches,
                                  std::size_t first, std::size_t end, int* parted) {
  return HWY_DYNAMIC_DISPATCH(evaluate_all)(scene, state, lists, touches, first, end, parted);
}

}  // namespace cellcrush
#endif
