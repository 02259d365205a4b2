#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>

#include "contact/search/candidate_lists.h"
#include "contact/start_overlaps.h"
#include "contact/touch/contact_stages.h"

namespace cellcrush {
namespace {

bool comes_before(int ball, int segment, const NewContact& pair) {
  return ball != pair.ball ? ball < pair.ball : segment < pair.segment;
}

/// Index of the first earlier pair that does not come before this one. The ball is found by a binary search without a
/// branch, which no predictor could guess.
std::size_t index_among(const TouchMemory& touching, const NewContact& pair) {
  const int* const balls = touching.ball.data();
  std::size_t first = 0;
  for (std::size_t left = touching.count(); left > 0;) {
    const std::size_t half = (left + 1) / 2;
    first += balls[first + half - 1] < pair.ball ? half : 0;
    left -= half;
  }
  while (first < touching.count() && comes_before(balls[first], touching.segment[first], pair)) {
    ++first;
  }
  return first;
}

/// A found pair either touched before and was found again in a rebuilt list, or is a new contact.
void match_or_add(NewContact pair, TouchMemory& touching, std::vector<NewContact>& new_contacts) {
  const std::size_t at = index_among(touching, pair);
  pair.next = static_cast<int>(at);
  const bool touches = at < touching.count() && touching.ball[at] == pair.ball &&
                       touching.segment[at] == pair.segment && touching.side[at] != 0;
  if (touches) {
    touching.place[at] = pair.index;
  } else {
    new_contacts.push_back(pair);
  }
}

/// Classifies the pairs found in the faces of the band and of the band before.
void classify_found(const LatticeBand& band, ContactLists& lists, ContactWorkspace& workspace,
                    std::vector<NewContact>& of_next_band) {
  workspace.new_contacts.clear();
  for (const NewContact& pair : of_next_band) {
    match_or_add(pair, lists.touching, workspace.new_contacts);
  }
  of_next_band.clear();
  const bool has_all = lists.face_list.empty();  // a search by buckets
  for (const int index : workspace.found) {
    const NewContact pair = {lists.candidate_ball[index], lists.candidate_segment[index], index};
    if (has_all || band.owns(pair.ball)) {
      match_or_add(pair, lists.touching, workspace.new_contacts);
    } else {
      of_next_band.push_back(pair);
    }
  }
  std::sort(workspace.new_contacts.begin(), workspace.new_contacts.end(),
            [](const NewContact& a, const NewContact& b) { return comes_before(a.ball, a.segment, b); });
}

/// Calls visit(field, field of the other) for the data that a pair keeps while it touches.
template <class Visit>
void visit_kept(const Scene& scene, TouchMemory& touching, const TouchMemory& before, Visit&& visit) {
  visit(touching.ball, before.ball);
  visit(touching.segment, before.segment);
  visit(touching.reach, before.reach);
  visit(touching.place, before.place);
  visit(touching.linked, before.linked);
  visit(touching.side, before.side);
  if (scene.contact.bends) {
    visit(touching.bend, before.bend);
  }
}

/// Writes the pairs that touch from now on, one after the other.
struct Writer {
  const Scene& scene;
  const State& state;
  const std::vector<int>& released;  ///< indices into the earlier pairs
  ContactWorkspace& workspace;
  TouchMemory& after;
  const TouchMemory& before = workspace.before;
  LaneVector<int>& known = workspace.touches.known;
  int count = 0;           ///< pairs written
  int next = 0;            ///< next of the earlier pairs
  std::size_t passed = 0;  ///< number of released pairs that have been passed

  /// Copies the earlier pairs up to `end`, without the released ones.
  void copy_until(int end) {
    for (; passed < released.size() && released[passed] < end; ++passed) {
      copy_run(released[passed]);
      note_change(before.ball[next++]);
    }
    copy_run(end);
  }

  void put(const NewContact& pair) {
    note_change(pair.ball);
    after.ball[count] = pair.ball;
    after.segment[count] = pair.segment;
    after.reach[count] = reach_now(scene, state, pair.ball, pair.segment);
    after.place[count] = pair.index;
    after.linked[count] = 0;
    after.side[count] = 0;
    if (scene.contact.bends) {
      after.bend[count] = bend_of(state, scene.elements[pair.segment]);
    }
    known[count] = Touches::kNew;
    ++count;
  }

  void note_change(int ball) { workspace.changes.push_back({ball, count}); }

  void copy_run(int end) {
    const int run = end - next;
    visit_kept(scene, after, before,
               [&](auto& field, const auto& old) { std::copy_n(old.begin() + next, run, field.begin() + count); });
    std::iota(known.begin() + count, known.begin() + count + run, next);
    count += run;
    next = end;
  }
};

}  // namespace

void link_pairs_of_ball(const Scene& scene, TouchMemory& touching, int ball, int index) {
  const auto [begin, end] = pairs_of_ball(touching, ball, index);
  for (int i = begin; i < end; ++i) {
    touching.linked[i] = 0;
    for (int j = begin; j < end; ++j) {
      const bool joined =
          j != i && share_a_node(scene.elements[touching.segment[i]], scene.elements[touching.segment[j]]);
      touching.linked[i] |= joined ? 1 : 0;
    }
  }
}

void remember_touches(const Scene& scene, const State& state, const LatticeBand& band, ContactLists& lists,
                      ContactWorkspace& workspace, std::vector<NewContact>& of_next_band) {
  classify_found(band, lists, workspace, of_next_band);
  std::swap(lists.touching, workspace.before);
  const std::size_t count = workspace.before.count() - lists.released.size() + workspace.new_contacts.size();
  visit_kept(scene, lists.touching, workspace.before,
             [&](auto& field, const auto&) { resize_with_room(field, count); });
  workspace.touches.resize(count);
  workspace.changes.clear();
  Writer writer = {scene, state, lists.released, workspace, lists.touching};
  for (const NewContact& pair : workspace.new_contacts) {
    writer.copy_until(pair.next);
    writer.put(pair);
  }
  writer.copy_until(static_cast<int>(workspace.before.count()));
  for (const ChangedBall& changed : workspace.changes) {
    link_pairs_of_ball(scene, lists.touching, changed.ball, changed.index);
  }
}

}  // namespace cellcrush
