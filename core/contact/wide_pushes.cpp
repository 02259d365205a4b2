#include "contact/wide_pushes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "contact/wide_pushes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "contact/push_effects.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Adds a share of a pair's forces, elastic x and y, viscous x and y, to those of a particle.
template <class D>
HWY_INLINE void add(D d, const double* HWY_RESTRICT pair, double share, ContactForce& to) {
  double* values = to.elastic.data();
  for (std::size_t k = 0; k < 4; k += hn::Lanes(d)) {
    const auto force = hn::Mul(hn::Set(d, share), hn::LoadU(d, pair + k));
    hn::StoreU(hn::Add(hn::LoadU(d, values + k), force), d, values + k);
  }
}

/// Pointers in place of the vectors, which would be asked anew where their numbers lie after every store of a number.
void apply(const Scene& scene, State& state, const TouchMemory& touching, ContactWorkspace& workspace,
           ContactTotals& totals) {
  const hn::CappedTag<double, 4> d;
  const Touches& touches = workspace.touches;
  const int* balls = touching.ball.data();
  const int* starts = touches.start.data();
  const int* ends = touches.end.data();
  const double* depths = touches.depth.data();
  const double* shares = touches.share.data();
  const Vector2* normals = touches.normal.data();
  const double stiffness = scene.contact.stiffness;
  ContactForce* forces = state.contact_force.data();
  DepthRecords records(scene, touching, touches, totals);
  double squared_depths = 0.0;
  for (Push& push : workspace.pushes) {
    const int touch = push.touch;
    const double depth = depths[touch];
    const Vector2 normal = normals[touch];
    const NormalForce net = push_pair(scene, touches, push);
    const double elastic = stiffness * depth;
    const double pair[] = {elastic * normal.x(), elastic * normal.y(), net.viscous * normal.x(),
                           net.viscous * normal.y()};
    const double share = shares[touch];
    add(d, pair, 1.0, forces[balls[touch]]);
    add(d, pair, share - 1.0, forces[starts[touch]]);
    add(d, pair, -share, forces[ends[touch]]);
    squared_depths += depth * depth;
    if (push.node_touch != Push::kNone) {
      take_back_node(scene, state, touching, touches, push.node_touch, totals.stored);
    }
    records.note(touch);
  }
  totals.stored += 0.5 * stiffness * squared_depths;
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cellcrush {

HWY_EXPORT(apply);

void apply_normal_forces_wide(const Scene& scene, State& state, const TouchMemory& touching,
                              ContactWorkspace& workspace, ContactTotals& totals) {
  HWY_DYNAMIC_DISPATCH(apply)(scene, state, touching, workspace, totals);
}

}  // namespace cellcrush
#endif
