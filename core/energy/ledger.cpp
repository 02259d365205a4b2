#include "energy/ledger.h"

#include "energy/energy_kernels.h"
#include "push/push.h"

namespace cellcrush {
namespace {

/// The works of the newest forces over the half step up to the time of the state, and twice the kinetic energy at that
/// time.
MotionWorks works_of_half_step(const Scene& scene, const State& state) {
  MotionWorks works = half_step_works(scene, state);
  for (const Pusher* pusher : pushers()) {
    works.add(pusher->half_step_works(scene, state));
  }
  return works;
}

}  // namespace

void open_ledger(const Scene& scene, State& state) {
  const MotionWorks start = works_of_half_step(scene, state);
  start.accumulate(state.ledger, -1.0);
  state.ledger.initial = 0.5 * start.twice_kinetic;
}

Energies evaluate_energies(const Scene& scene, const State& state) {
  const MotionWorks newest = works_of_half_step(scene, state);
  Energies now{state.ledger};
  newest.accumulate(now);
  now.kinetic = 0.5 * newest.twice_kinetic;
  now.elastic = elastic_energy(scene, state);
  now.residual = residual_of(now);
  return now;
}

}  // namespace cellcrush
