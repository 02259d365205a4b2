#include "step/advance_step.h"

#include "beam/internal_forces.h"
#include "contact/contact_forces.h"
#include "contact/contact_lots.h"
#include "contact/contact_sums.h"
#include "contact/find_contacts.h"
#include "contact/plate_forces.h"
#include "energy/ledger.h"
#include "step/advance_block.h"
#include "step/integrate_motion.h"
#include "step/loads.h"
#include "step/stage_teller.h"

namespace cellcrush {
namespace {

/// The contacts' and the plates' forces on a band's particles, or on all.
void evaluate_contacts(const Scene& scene, State& state, std::size_t band, const NearPlates& near_plates,
                       Workspace& workspace, const StageTeller& teller, ContactSums& sums) {
  teller.begin(Stage::evaluate_contact_forces);
  evaluate_contact_forces(scene, state, band, workspace.contact, workspace.workers, sums);
  teller.begin(Stage::evaluate_plate_forces);
  evaluate_plate_forces(scene, state, plate_motion_of(scene, state), scene.bands[band], near_plates, sums);
}

void evaluate_all_contacts(const Scene& scene, State& state, const NearPlates& near_plates, Workspace& workspace,
                           const StageTeller& teller) {
  teller.begin(Stage::find_contacts);
  find_contacts(scene, state, workspace.workers);
  teller.begin(Stage::evaluate_contact_forces);
  renew_contact_lots(scene, state, 1);
  ContactSums sums = begin_contact_sums(state);
  const bool is_whole = scene.bands.size() == 1;
  for (std::size_t b = 0; b < scene.bands.size(); ++b) {
    evaluate_contacts(scene, state, b, is_whole ? near_plates : std::nullopt, workspace, teller, sums);
  }
  put_contact_sums(sums, state);
}

void evaluate_forces(const Scene& scene, State& state, const NearPlates& near_plates, Workspace& workspace,
                     const StageTeller& teller) {
  const auto evaluate_meanwhile = [&] {
    evaluate_all_contacts(scene, state, near_plates, workspace, teller);
    teller.begin(Stage::evaluate_internal_forces);  // what is left of them
  };
  teller.begin(Stage::evaluate_internal_forces);
  evaluate_internal_forces(scene, state, workspace.walls, workspace.workers, evaluate_meanwhile);
  teller.begin(Stage::evaluate_loads);
  evaluate_loads(scene, state);
}

}  // namespace

State make_initial_state(const Scene& scene) {
  State state = place_particles(scene);
  Workspace workspace;
  evaluate_forces(scene, state, std::nullopt, workspace, StageTeller(nullptr));
  stagger_velocities(scene, state);
  open_ledger(scene, state);
  return state;
}

void advance_step(const Scene& scene, State& state, Workspace& workspace, StageObserver* observer) {
  const StageTeller teller(observer);
  teller.begin(Stage::integrate_motion);
  const NearPlates near_plates = integrate_motion(scene, state, workspace.motion, workspace.workers);
  evaluate_forces(scene, state, near_plates, workspace, teller);
  teller.end_step();
}

void advance_steps(const Scene& scene, State& state, Workspace& workspace, std::int64_t steps,
                   StageObserver* observer) {
  const std::int64_t end = state.step + steps;
  while (state.step < end) {
    if (can_advance_blocks(scene, state)) {
      advance_block(scene, state, workspace, steps_in_block(end - state.step), observer);
    } else {
      advance_step(scene, state, workspace, observer);
    }
  }
}

void advance_step(const Scene& scene, State& state, StageObserver* observer) {
  Workspace workspace;
  advance_step(scene, state, workspace, observer);
}

}  // namespace cellcrush
