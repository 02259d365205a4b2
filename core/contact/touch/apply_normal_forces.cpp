#include "contact/touch/contact_stages.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "contact/touch/apply_normal_forces.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "contact/touch/normal_forces-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

void add_normal_forces(const Scene& scene, State& state, const TouchMemory& touching, ContactWorkspace& workspace,
                       ContactTotals& totals) {
  const TouchArrays of = {touching, workspace.touches};
  ContactForce* forces = state.contact_force.data();
  double squared_depths = 0.0;
  for (ActiveContact& contact : workspace.active) {
    add_normal_force(scene, state, forces, of, contact, squared_depths, totals);
  }
  totals.stored += 0.5 * scene.contact.stiffness * squared_depths;
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cellcrush {

HWY_EXPORT(add_normal_forces);

void apply_normal_forces(const Scene& scene, State& state, const TouchMemory& touching, ContactWorkspace& workspace,
                         ContactTotals& totals) {
  HWY_DYNAMIC_DISPATCH(add_normal_forces)(scene, state, touching, workspace, totals);
}

}  // namespace cellcrush
#endif
