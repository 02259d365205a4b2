#include <algorithm>
#include <span>
#include <utility>

#include "contact/touch/contact_stages.h"
#include "contact/touch/friction-inl.h"

namespace cellcrush {
namespace {

/// The touches of the step before, sorted by ball.
struct TouchesBefore {
  const TouchMemory& touching;  ///< now
  const Touches& touches;
  const TouchMemory& before;
  std::span<const ActiveContact> active;

  [[nodiscard]] PairRange range_of(int ball) const {
    const auto [first, end] = std::equal_range(before.ball.begin(), before.ball.end(), ball);
    return {static_cast<int>(first - before.ball.begin()), static_cast<int>(end - before.ball.begin())};
  }
  [[nodiscard]] int segment(int earlier) const { return before.segment[earlier]; }
  [[nodiscard]] int pushed(int earlier) const { return before.pushed[earlier]; }
  [[nodiscard]] double friction(int earlier) const { return before.friction[earlier]; }

  [[nodiscard]] bool has_friction(int earlier) const {
    const auto precedes = [&](const ActiveContact& contact, int memory) {
      return std::pair(touching.ball[contact.touch], touching.segment[contact.touch]) <
             std::pair(before.ball[memory], before.segment[memory]);
    };
    const auto found = std::lower_bound(active.begin(), active.end(), earlier, precedes);
    return found != active.end() && touches.known[found->touch] == earlier && found->has_pair;
  }
};

}  // namespace

void apply_friction(const Scene& scene, State& state, TouchMemory& touching, const ContactWorkspace& workspace) {
  touching.pushed.assign(touching.count(), 0);
  touching.friction.assign(touching.count(), 0.0);
  const TouchesBefore before = {touching, workspace.touches, workspace.before, workspace.active};
  for (const ActiveContact& contact : workspace.active) {
    HWY_NAMESPACE::rub_pair(scene, state, touching, workspace.touches, before, contact);
  }
}

}  // namespace cellcrush
