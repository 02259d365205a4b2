#include "contact/remember_touches.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>

namespace cellcrush {
namespace {

bool comes_before(int ball, int segment, const Newcomer& pair) {
  return ball != pair.ball ? ball < pair.ball : segment < pair.segment;
}

/// Of the pairs that touched before, the first that does not come before this one.
std::size_t place_among(const TouchMemory& touching, const Newcomer& pair) {
  std::size_t first = 0;
  for (std::size_t end = touching.count(); first < end;) {
    const std::size_t middle = (first + end) / 2;
    if (comes_before(touching.ball[middle], touching.segment[middle], pair)) {
      first = middle + 1;
    } else {
      end = middle;
    }
  }
  return first;
}

/// Sorts out what was found: pairs that touch all along, in a list that was made anew, and newcomers.
void recognize(State& state, ContactWorkspace& workspace) {
  TouchMemory& touching = state.touching;
  workspace.newcomers.clear();
  for (const int place : workspace.found) {
    Newcomer pair = {state.candidate_ball[place], state.candidate_segment[place], place};
    const std::size_t at = place_among(touching, pair);
    pair.next = static_cast<int>(at);
    const bool touches = at < touching.count() && touching.ball[at] == pair.ball &&
                         touching.segment[at] == pair.segment && touching.side[at] != 0;
    if (touches) {
      touching.place[at] = place;
    } else {
      workspace.newcomers.push_back(pair);
    }
  }
  std::sort(workspace.newcomers.begin(), workspace.newcomers.end(),
            [](const Newcomer& a, const Newcomer& b) { return comes_before(a.ball, a.segment, b); });
}

/// Calls visit(field, field of the other) for what a pair keeps while it touches.
template <class Visit>
void visit_kept(TouchMemory& touching, const TouchMemory& before, Visit&& visit) {
  visit(touching.ball, before.ball);
  visit(touching.segment, before.segment);
  visit(touching.reach, before.reach);
  visit(touching.place, before.place);
  visit(touching.linked, before.linked);
  visit(touching.side, before.side);
}

/// The pairs that touch from now on, written one after the other.
class Writer {
 public:
  Writer(State& state, ContactWorkspace& workspace)
      : state_(state), before_(workspace.before), known_(workspace.touches.known) {
    const std::size_t count = before_.count() - state.parted.size() + workspace.newcomers.size();
    visit_kept(state.touching, before_, [&](auto& field, const auto&) { field.resize(count); });
    workspace.touches.resize(count);
  }

  /// Those before up to this one, but the parted.
  void copy_until(std::size_t end) {
    while (next_ < end) {
      const bool parts = parted_ < state_.parted.size() && static_cast<std::size_t>(state_.parted[parted_]) < end;
      copy_run(parts ? static_cast<std::size_t>(state_.parted[parted_]) : end);
      if (parts) {
        ++parted_;
        ++next_;
      }
    }
  }

  void put(const Newcomer& pair) {
    TouchMemory& touching = state_.touching;
    touching.ball[count_] = pair.ball;
    touching.segment[count_] = pair.segment;
    touching.reach[count_] = state_.candidate_reach[pair.place];
    touching.place[count_] = pair.place;
    touching.linked[count_] = 0;
    touching.side[count_] = 0;
    known_[count_] = Touches::kNew;
    ++count_;
  }

 private:
  void copy_run(std::size_t end) {
    visit_kept(state_.touching, before_, [&](auto& field, const auto& old) {
      std::copy(old.begin() + static_cast<std::ptrdiff_t>(next_), old.begin() + static_cast<std::ptrdiff_t>(end),
                field.begin() + static_cast<std::ptrdiff_t>(count_));
    });
    const auto first = known_.begin() + static_cast<std::ptrdiff_t>(count_);
    std::iota(first, first + static_cast<std::ptrdiff_t>(end - next_), static_cast<int>(next_));
    count_ += end - next_;
    next_ = end;
  }

  State& state_;
  const TouchMemory& before_;
  LaneVector<int>& known_;
  std::size_t count_ = 0;   // written
  std::size_t next_ = 0;    // of those before
  std::size_t parted_ = 0;  // passed of State::parted
};

/// Says anew which pairs of a ball are linked.
void link(const Scene& scene, TouchMemory& touching, int ball) {
  const auto [first, last] = std::equal_range(touching.ball.begin(), touching.ball.end(), ball);
  const auto begin = static_cast<std::size_t>(first - touching.ball.begin());
  const auto end = static_cast<std::size_t>(last - touching.ball.begin());
  for (std::size_t i = begin; i < end; ++i) {
    touching.linked[i] = 0;
    for (std::size_t j = begin; j < end; ++j) {
      const bool joined =
          j != i && share_a_node(scene.elements[touching.segment[i]], scene.elements[touching.segment[j]]);
      touching.linked[i] |= joined ? 1 : 0;
    }
  }
}

}  // namespace

void remember_touches(const Scene& scene, State& state, ContactWorkspace& workspace) {
  recognize(state, workspace);
  std::swap(state.touching, workspace.before);
  Writer writer(state, workspace);
  for (const Newcomer& pair : workspace.newcomers) {
    writer.copy_until(static_cast<std::size_t>(pair.next));
    writer.put(pair);
  }
  writer.copy_until(workspace.before.count());
  for (const Newcomer& pair : workspace.newcomers) {
    link(scene, state.touching, pair.ball);
  }
  for (const int gone : state.parted) {
    link(scene, state.touching, workspace.before.ball[gone]);
  }
}

}  // namespace cellcrush
