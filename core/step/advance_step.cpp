#include "step/advance_step.h"

#include "beam/internal_forces.h"
#include "contact/contact_forces.h"
#include "contact/contact_lots.h"
#include "contact/contact_sums.h"
#include "contact/find_contacts.h"
#include "contact/plate_forces.h"
#include "energy/ledger.h"
#include "scene/bands.h"
#include "step/integrate_motion.h"
#include "step/loads.h"

namespace cellcrush {
namespace {

class StageTeller {
 public:
  explicit StageTeller(StageObserver* observer) : observer_(observer) {}
  void begin(Stage stage) const {
    if (observer_ != nullptr) {
      observer_->begin(stage);
    }
  }
  void end_step() const {
    if (observer_ != nullptr) {
      observer_->end_step();
    }
  }

 private:
  StageObserver* observer_;
};

/// The contacts' and the plates' forces on a band's particles, or on all.
void evaluate_contacts(const Scene& scene, State& state, ContactLists& lists, const LatticeBand& band,
                       const NearPlates& near_plates, Workspace& workspace, const StageTeller& teller,
                       ContactSums& sums) {
  teller.begin(Stage::evaluate_contact_forces);
  evaluate_contact_forces(scene, state, lists, workspace.contact, workspace.workers, sums.walls);
  teller.begin(Stage::evaluate_plate_forces);
  evaluate_plate_forces(scene, state, plate_motion_of(scene, state), band, near_plates, sums);
}

void evaluate_all_contacts(const Scene& scene, State& state, const NearPlates& near_plates, Workspace& workspace,
                           const StageTeller& teller) {
  teller.begin(Stage::find_contacts);
  find_contacts(scene, state, workspace.workers);
  teller.begin(Stage::evaluate_contact_forces);
  renew_contact_lots(scene, state, 1);
  ContactSums sums = begin_contact_sums(state);
  if (state.contacts.size() == 1) {
    evaluate_contacts(scene, state, state.contacts.front(), whole_band(scene), near_plates, workspace, teller, sums);
  } else {
    for (std::size_t b = 0; b < state.contacts.size(); ++b) {
      evaluate_contacts(scene, state, state.contacts[b], scene.bands[b], std::nullopt, workspace, teller, sums);
    }
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

void advance_step(const Scene& scene, State& state, StageObserver* observer) {
  Workspace workspace;
  advance_step(scene, state, workspace, observer);
}

}  // namespace cellcrush
