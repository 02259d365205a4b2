#include "step/break_walls.h"

#include <vector>

#include "contact/contact_search.h"
#include "fracture/new_ends.h"
#include "fracture/part_walls.h"
#include "step/advance_step.h"

namespace cellcrush {

std::shared_ptr<const Scene> WallBreaker::break_walls(const Scene& scene, State& state, Workspace& workspace) {
  const std::vector<FailedEnd> ends = search_.find(scene, state);
  if (ends.empty()) return nullptr;
  const std::shared_ptr<Scene> after = part_mesh(scene, ends);
  limit_new_ends(scene, ends, *after, state);
  note_breaks(scene, ends, state);
  part_state(scene, *after, ends, state);
  if (after->contact.present) change_topology(*after, state, TopologyChange::walls_changed, state.step);
  evaluate_forces_again(*after, state, workspace);
  return after;
}

}  // namespace cellcrush
