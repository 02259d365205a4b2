#include "step/stages.h"

#include <span>

#include "beam/internal_forces.h"
#include "contact/contact_forces.h"
#include "motion/integrate_motion.h"
#include "touch/plate_forces.h"
#include "touch/rigid_wall_forces.h"

namespace cellcrush {

void move_band(const Scene& scene, State& state, std::size_t band, StepRecord& record, StageWorkspace& workspace,
               std::vector<int>& near_plates) {
  record.near[band] =
      integrate_motion(scene, state, scene.bands[band], record.reach, workspace.workers, record.moved, near_plates);
}

void evaluate_band_walls(const Scene& scene, State& state, std::size_t band, StepRecord& record,
                         StageWorkspace& workspace) {
  evaluate_internal_forces(scene, state, scene.bands[band], workspace.walls, workspace.workers,
                           record.plastic_work.data());
}

void evaluate_band_contacts(const Scene& scene, State& state, std::size_t band, StepRecord& record,
                            StageWorkspace& workspace) {
  evaluate_contact_forces(scene, state, band, workspace.contact, workspace.workers, record.contacts);
}

void evaluate_band_plates(const Scene& scene, State& state, std::size_t band, StepRecord& record,
                          const std::vector<int>& near_plates) {
  const std::span<const int> near(near_plates);
  const NearCounts& counts = record.near[band];
  const auto evaluate = [&](int first, std::size_t count) {
    evaluate_plate_forces(scene, state, record.plate, near.subspan(static_cast<std::size_t>(first), count),
                          record.contacts);
  };
  const LatticeBand& of = scene.bands[band];
  evaluate(of.first_joint, counts.joints);
  evaluate(of.first_inner, counts.inner);
  evaluate_rigid_wall_forces(scene, state, of.first_joint, of.end_joint, record.contacts);
  evaluate_rigid_wall_forces(scene, state, of.first_inner, of.end_inner, record.contacts);
}

}  // namespace cellcrush
