#include "energy/ledger.h"

#include "energy/elastic_energy.h"
#include "energy/motion_energy.h"
#include "motion/plate_motion.h"

namespace cellcrush {
namespace {

/// Kinetic energy at the time of the state, and the work of the newest forces over the half step up to it.
struct EnergySnapshot {
  double kinetic = 0.0;
  Ledger half;
};

EnergySnapshot sample_energy(const Scene& scene, const State& state) {
  const double half = 0.5 * scene.schedule.time_step;
  const MotionWorks works = half_step_works(scene, state);
  EnergySnapshot snapshot;
  works.accumulate(snapshot.half);
  accumulate_plate_work(state, half * scene.plates.speed_at(state.time - half), snapshot.half);
  snapshot.kinetic = 0.5 * works.twice_kinetic;
  return snapshot;
}

}  // namespace

void open_ledger(const Scene& scene, State& state) {
  const EnergySnapshot start = sample_energy(scene, state);
  state.ledger.contact -= start.half.contact;
  state.ledger.contact_damping -= start.half.contact_damping;
  state.ledger.friction -= start.half.friction;
  state.ledger.mass_damping -= start.half.mass_damping;
  state.ledger.external -= start.half.external;
  state.ledger.initial = start.kinetic;
}

Energies evaluate_energies(const Scene& scene, const State& state) {
  const EnergySnapshot now = sample_energy(scene, state);
  Energies energies;
  energies.kinetic = now.kinetic;
  energies.elastic = elastic_energy(scene, state);
  energies.plastic = state.ledger.plastic;
  energies.contact = state.ledger.contact + now.half.contact;
  energies.contact_damping = state.ledger.contact_damping + now.half.contact_damping;
  energies.friction = state.ledger.friction + now.half.friction;
  energies.mass_damping = state.ledger.mass_damping + now.half.mass_damping;
  energies.external = state.ledger.external + now.half.external;
  energies.residual = energies.external + state.ledger.initial - energies.kinetic - energies.elastic -
                      energies.plastic - energies.contact - energies.contact_damping - energies.friction -
                      energies.mass_damping;
  return energies;
}

}  // namespace cellcrush
