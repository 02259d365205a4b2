#include "contact/contact_lots.h"

namespace cellcrush {
namespace {

constexpr std::int64_t kStepsBetweenRenewals = 64;

void mark_pair(const Scene& scene, State& state, int ball, int segment) {
  mark_contact_lot(state, ball);
  mark_contact_lot(state, scene.elements[segment].start);
  mark_contact_lot(state, scene.elements[segment].end);
}

}  // namespace

void note_contact_lots(const Scene& scene, State& state, std::span<const Newcomer> newcomers) {
  if (state.contact_lots.empty() || state.step % kStepsBetweenRenewals == 0) {
    state.contact_lots.assign(scene.particle_count() / State::kContactLot + 1, 0);
    for (std::size_t i = 0; i < state.touching.count(); ++i) {
      mark_pair(scene, state, state.touching.ball[i], state.touching.segment[i]);
    }
    return;
  }
  for (const Newcomer& pair : newcomers) {
    mark_pair(scene, state, pair.ball, pair.segment);
  }
}

}  // namespace cellcrush
