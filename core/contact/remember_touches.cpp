#include "contact/remember_touches.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace cellcrush {
namespace {

/// No candidate: the pair touches no more.
constexpr std::int64_t kGone = -1;

std::int64_t key_of(int ball, int segment) { return (static_cast<std::int64_t>(ball) << 32) + segment; }

/// Place of a pair among those before; kNew if it was not among them.
int find_before(const TouchMemory& before, const Newcomer& pair) {
  int first = 0;
  int end = static_cast<int>(before.count());
  while (first < end) {
    const int middle = (first + end) / 2;
    if (key_of(before.ball[middle], before.segment[middle]) < key_of(pair.ball, pair.segment)) {
      first = middle + 1;
    } else {
      end = middle;
    }
  }
  const bool found = first < static_cast<int>(before.count()) && before.ball[first] == pair.ball &&
                     before.segment[first] == pair.segment;
  return found ? first : Touches::kNew;
}

/// Notes the candidates of the pairs that touched before; the others become newcomers.
void recognize(const State& state, ContactWorkspace& workspace) {
  const TouchMemory& before = workspace.before;
  workspace.rank.resize(state.candidate_ball.size());
  workspace.place.assign(before.count(), kGone);
  workspace.newcomers.clear();
  for (std::size_t i = 0; i < workspace.overlap_count; ++i) {
    const std::int64_t place = workspace.overlapping[i];
    const auto rank = static_cast<std::size_t>(workspace.rank[place]);
    const int ball = state.candidate_ball[place];
    const int segment = state.candidate_segment[place];
    if (rank < before.count() && before.ball[rank] == ball && before.segment[rank] == segment) {
      workspace.place[rank] = place;
    } else {
      workspace.newcomers.push_back({ball, segment, place});
    }
  }
}

/// Of the newcomers, those whose list was made anew are known all the same; sorts the others.
void sort_newcomers(ContactWorkspace& workspace) {
  std::vector<Newcomer>& newcomers = workspace.newcomers;
  const auto is_known = [&](const Newcomer& pair) {
    const int known = find_before(workspace.before, pair);
    if (known != Touches::kNew) {
      workspace.place[known] = pair.place;
    }
    return known != Touches::kNew;
  };
  newcomers.erase(std::remove_if(newcomers.begin(), newcomers.end(), is_known), newcomers.end());
  std::sort(newcomers.begin(), newcomers.end(),
            [](const Newcomer& a, const Newcomer& b) { return key_of(a.ball, a.segment) < key_of(b.ball, b.segment); });
}

void resize(TouchMemory& touching, std::size_t count) {
  touching.ball.resize(count);
  touching.segment.resize(count);
  touching.side.resize(count);
}

}  // namespace

void remember_touches(State& state, ContactWorkspace& workspace) {
  std::swap(state.touching, workspace.before);
  recognize(state, workspace);
  sort_newcomers(workspace);
  const TouchMemory& before = workspace.before;
  TouchMemory& touching = state.touching;
  resize(touching, workspace.overlap_count);
  workspace.touches.resize(workspace.overlap_count);
  std::size_t count = 0;
  const auto put = [&](std::int64_t place, int ball, int segment, int side, int known) {
    touching.ball[count] = ball;
    touching.segment[count] = segment;
    touching.side[count] = side;
    workspace.touches.reach[count] = state.candidate_reach[place];
    workspace.touches.known[count] = known;
    workspace.rank[place] = static_cast<int>(count);
    ++count;
  };
  std::size_t known = 0;
  const auto put_known_until = [&](std::int64_t key) {
    for (; known < before.count() && key_of(before.ball[known], before.segment[known]) < key; ++known) {
      if (workspace.place[known] != kGone) {
        put(workspace.place[known], before.ball[known], before.segment[known], before.side[known],
            static_cast<int>(known));
      }
    }
  };
  for (const Newcomer& pair : workspace.newcomers) {
    put_known_until(key_of(pair.ball, pair.segment));
    put(pair.place, pair.ball, pair.segment, 0, Touches::kNew);
  }
  put_known_until(INT64_MAX);
}

}  // namespace cellcrush
