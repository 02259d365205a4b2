#include "contact/contact_forces.h"

#include <vector>

#include "contact/contact_tiles.h"
#include "contact/search/candidate_lists.h"
#include "contact/touch/contact_stages.h"

namespace cellcrush {
namespace {

/// The first touch from `touch` on that is the first of its ball.
std::size_t begin_of_ball(const TouchMemory& touching, std::size_t touch) {
  while (touch > 0 && touch < touching.count() && touching.ball[touch - 1] == touching.ball[touch]) {
    ++touch;
  }
  return touch;
}

/// Has a released pair tested again from the next step on, in the list that holds it.
void wake(std::vector<ContactLists>& contacts, std::size_t band, int touch) {
  const TouchMemory& touching = contacts[band].touching;
  for (std::size_t home = band > 0 ? band - 1 : 0; home <= band; ++home) {
    wake_candidate(contacts[home], touching.place[touch], touching.ball[touch], touching.segment[touch]);
  }
}

/// Evaluates the touches and finds the active contacts; each thread does those of its balls.
void evaluate_pairs(const Scene& scene, State& state, std::size_t band, ContactWorkspace& workspace, Workers& workers) {
  ContactLists& lists = state.contacts[band];
  const TouchMemory& touching = lists.touching;
  workers.parallel_ranges(touching.count(), 1, [&](std::size_t p, std::size_t part_first, std::size_t part_end) {
    const std::size_t first = begin_of_ball(touching, part_first);
    const std::size_t end = begin_of_ball(touching, part_end);
    ContactPart& part = workspace.parts[p];
    evaluate_touches(scene, state, lists, workspace.touches, first, end, part.released);
    if (scene.contact.bends) {
      bend_segments(scene, state, touching, workspace.touches, first, end);
    }
    find_active_contacts(scene, state, lists, workspace.touches, first, end, part.active);
  });
  lists.released.clear();
  for (const ContactPart& part : workspace.parts) {
    for (const int i : part.released) {
      lists.released.push_back(i);
      wake(state.contacts, band, i);
    }
  }
  workspace.active.clear();
  if (workspace.parts.size() == 1) {
    workspace.active.swap(workspace.parts.front().active);
    return;
  }
  for (const ContactPart& part : workspace.parts) {
    workspace.active.insert(workspace.active.end(), part.active.begin(), part.active.end());
  }
}

}  // namespace

void evaluate_contact_forces(const Scene& scene, State& state, std::size_t band, ContactWorkspace& workspace,
                             Workers& workers, ContactSums& sums) {
  ContactLists& lists = state.contacts[band];
  workspace.parts.resize(static_cast<std::size_t>(workers.count()));
  find_overlaps(scene, state, lists, workspace, workers);
  remember_touches(scene, state, scene.bands[band], lists, workspace, sums.of_next_band);
  for (const NewContact& pair : workspace.new_contacts) {
    mark_contact_tiles(scene, state, pair.ball, pair.segment);
  }
  evaluate_pairs(scene, state, band, workspace, workers);
  apply_normal_forces(scene, state, lists.touching, workspace, sums.walls);
  if (scene.contact.bends) {
    apply_bending_forces(scene, state, lists.touching, workspace);
  }
  sums.walls.count += static_cast<std::int64_t>(workspace.active.size());
  if (scene.contact.friction > 0.0) {
    apply_friction(scene, state, lists.touching, workspace);
  }
}

}  // namespace cellcrush
