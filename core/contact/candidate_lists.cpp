#include "contact/candidate_lists.h"

#include <limits>
#include <utility>

namespace cellcrush {
namespace {

/// Empty batches that are always let be.
constexpr std::int64_t kEmptyBatches = 128;

/// Alarm of what is not tested.
constexpr double kNever = std::numeric_limits<double>::infinity();

int batches_for(int count) { return (count + kCandidateBatch - 1) / kCandidateBatch; }

void put(State& state, int place, const Candidate& candidate) {
  state.candidate_ball[place] = candidate.ball;
  state.candidate_segment[place] = candidate.segment;
  state.candidate_reach[place] = candidate.reach;
  state.candidate_alarm[place] = candidate.reach > 0.0 ? 0.0 : kNever;
}

void resize(State& state, std::size_t size) {
  state.candidate_ball.resize(size, 0);
  state.candidate_segment.resize(size, 0);
  state.candidate_reach.resize(size, 0.0);
  state.candidate_alarm.resize(size, kNever);
}

/// Gives a list another place, at the end. What it held is lost.
void move_to_end(State& state, FaceList& list, int count) {
  for (int i = 0; i < list.count; ++i) {
    put(state, list.first + i, Candidate());
  }
  list.first = static_cast<int>(state.candidate_ball.size());
  list.room = batches_for(count) * kCandidateBatch;
  list.count = 0;
  resize(state, state.candidate_ball.size() + list.room);
  state.batch_group.resize(state.candidate_ball.size() / kCandidateBatch, list.group);
}

void close_up(State& state) {
  const std::vector<int> ball = std::move(state.candidate_ball);
  const std::vector<int> segment = std::move(state.candidate_segment);
  const std::vector<double> reach = std::move(state.candidate_reach);
  clear_candidates(state);
  for (FaceList& list : state.face_list) {
    const FaceList before = list;
    list.count = 0;
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
  state.batch_count += batches_for(count) - batches_for(list.count);
  if (count > list.room) {
    move_to_end(state, list, count);
  }
  for (int i = 0; i < list.count || i < count; ++i) {
    put(state, list.first + i, i < count ? candidates[i] : Candidate());
  }
  list.count = count;
  if (static_cast<std::int64_t>(state.batch_group.size()) > state.batch_count + state.batch_count / 4 + kEmptyBatches) {
    close_up(state);
  }
}

void wake_candidate(State& state, int place, int ball, int segment) {
  const auto k = static_cast<std::size_t>(place);
  // Of a list that was made anew, and in which it was not found to overlap, it is tested anyhow.
  if (k < state.candidate_ball.size() && state.candidate_ball[k] == ball && state.candidate_segment[k] == segment) {
    state.candidate_alarm[k] = 0.0;
  }
}

void add_candidate(State& state, const Candidate& candidate) {
  resize(state, state.candidate_ball.size() + 1);
  put(state, static_cast<int>(state.candidate_ball.size()) - 1, candidate);
  ++state.candidate_count;
}

void fill_batch(State& state) {
  resize(state, static_cast<std::size_t>(batches_for(static_cast<int>(state.candidate_ball.size()))) * kCandidateBatch);
}

void clear_candidates(State& state) {
  resize(state, 0);
  state.batch_group.clear();
}

}  // namespace cellcrush
