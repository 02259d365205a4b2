#include "contact/candidate_lists.h"

#include <utility>

namespace cellcrush {
namespace {

/// Lists have room for a multiple of so many.
constexpr int kRoom = 4;
/// Empty places that are always let be.
constexpr std::int64_t kEmptyPlaces = 1024;

void put(State& state, int place, const Candidate& candidate) {
  state.candidate_ball[place] = candidate.ball;
  state.candidate_segment[place] = candidate.segment;
  state.candidate_reach[place] = candidate.reach;
}

void resize(State& state, std::size_t size) {
  state.candidate_ball.resize(size, 0);
  state.candidate_segment.resize(size, 0);
  state.candidate_reach.resize(size, 0.0);
}

/// Gives a list another place, at the end. What it held is lost.
void move_to_end(State& state, FaceList& list, int count) {
  for (int i = 0; i < list.count; ++i) {
    put(state, list.first + i, Candidate());
  }
  list.first = static_cast<int>(state.candidate_ball.size());
  list.room = (count + kRoom - 1) / kRoom * kRoom;
  list.count = 0;
  resize(state, state.candidate_ball.size() + list.room);
}

void close_up(State& state) {
  const std::vector<int> ball = std::move(state.candidate_ball);
  const std::vector<int> segment = std::move(state.candidate_segment);
  const std::vector<double> reach = std::move(state.candidate_reach);
  resize(state, 0);
  for (FaceList& list : state.face_list) {
    const FaceList before = list;
    list.count = 0;
    list.room = 0;
    move_to_end(state, list, before.count);
    list.count = before.count;
    for (int i = 0; i < list.count; ++i) {
      const int from = before.first + i;
      put(state, list.first + i, {ball[from], segment[from], reach[from]});
    }
  }
}

}  // namespace

void replace_list(State& state, int face, const std::vector<Candidate>& candidates) {
  FaceList& list = state.face_list[face];
  const int count = static_cast<int>(candidates.size());
  state.candidate_count += count - list.count;
  if (count > list.room) {
    move_to_end(state, list, count);
  }
  for (int i = 0; i < list.count || i < count; ++i) {
    put(state, list.first + i, i < count ? candidates[i] : Candidate());
  }
  list.count = count;
  const auto places = static_cast<std::int64_t>(state.candidate_ball.size());
  if (places > state.candidate_count + state.candidate_count / 4 + kEmptyPlaces) {
    close_up(state);
  }
}

}  // namespace cellcrush
