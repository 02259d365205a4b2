#include "touch/remember_touches.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>

#include "search/list_room.h"

namespace cellcrush {
namespace {

bool comes_before(int ball, int segment, const NewContact& pair) {
  return ball != pair.ball ? ball < pair.ball : segment < pair.segment;
}

/// Index of the first earlier pair that does not come before this one. The ball is found by a binary search without a
/// branch, which no predictor could guess.
std::size_t place_among(const TouchMemory& touching, const NewContact& pair) {
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
  const std::size_t at = place_among(touching, pair);
  pair.next = static_cast<int>(at);
  const bool touches = at < touching.count() && touching.ball[at] == pair.ball &&
                       touching.segment[at] == pair.segment && touching.side[at] != 0;
  if (touches) {
    touching.place[at] = pair.place;
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
  for (const int place : workspace.found) {
    const NewContact pair = {lists.candidate_ball[place], lists.candidate_segment[place], place};
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
void visit_kept(TouchMemory& touching, const TouchMemory& before, Visit&& visit) {
  visit(touching.ball, before.ball);
  visit(touching.segment, before.segment);
  visit(touching.reach, before.reach);
  visit(touching.place, before.place);
  visit(touching.linked, before.linked);
  visit(touching.side, before.side);
}

/// Writes the pairs that touch from now on, one after the other.
class Writer {
 public:
  Writer(const Scene& scene, ContactLists& lists, ContactWorkspace& workspace)
      : scene_(scene),
        lists_(lists),
        changes_(workspace.changes),
        before_(workspace.before),
        after_(lists.touching),
        known_(workspace.touches.known) {
    const std::size_t count = before_.count() - lists.released.size() + workspace.new_contacts.size();
    visit_kept(after_, before_, [&](auto& field, const auto&) { resize_with_room(field, count); });
    workspace.touches.resize(count);
    changes_.clear();
  }

  /// Copies the earlier pairs up to `end`, without the released ones.
  void copy_until(int end) {
    while (next_ < end) {
      const bool is_released = released_ < lists_.released.size() && lists_.released[released_] < end;
      copy_run(is_released ? lists_.released[released_] : end);
      if (is_released) {
        note_change(before_.ball[next_]);
        ++released_;
        ++next_;
      }
    }
  }

  void put(const NewContact& pair) {
    note_change(pair.ball);
    after_.ball[count_] = pair.ball;
    after_.segment[count_] = pair.segment;
    after_.reach[count_] = scene_.reach_of(pair.ball, pair.segment);
    after_.place[count_] = pair.place;
    after_.linked[count_] = 0;
    after_.side[count_] = 0;
    known_[count_] = Touches::kNew;
    ++count_;
  }

 private:
  void note_change(int ball) { changes_.push_back({ball, count_}); }

  void copy_run(int end) {
    const int count = end - next_;
    visit_kept(after_, before_,
               [&](auto& field, const auto& old) { std::copy_n(old.begin() + next_, count, field.begin() + count_); });
    std::iota(known_.begin() + count_, known_.begin() + count_ + count, next_);
    count_ += count;
    next_ = end;
  }

  const Scene& scene_;
  const ContactLists& lists_;
  std::vector<ChangedBall>& changes_;
  const TouchMemory& before_;
  TouchMemory& after_;
  LaneVector<int>& known_;
  int count_ = 0;             // pairs written
  int next_ = 0;              // next of the earlier pairs
  std::size_t released_ = 0;  // number of ContactLists::released that have been passed
};

/// Finds which pairs of a ball are linked.
void link(const Scene& scene, TouchMemory& touching, const ChangedBall& changed) {
  const auto [begin, end] = pairs_of_ball(touching, changed.ball, changed.place);
  for (int i = begin; i < end; ++i) {
    touching.linked[i] = 0;
    for (int j = begin; j < end; ++j) {
      const bool joined =
          j != i && share_a_node(scene.elements[touching.segment[i]], scene.elements[touching.segment[j]]);
      touching.linked[i] |= joined ? 1 : 0;
    }
  }
}

}  // namespace

void remember_touches(const Scene& scene, const LatticeBand& band, ContactLists& lists, ContactWorkspace& workspace,
                      std::vector<NewContact>& of_next_band) {
  classify_found(band, lists, workspace, of_next_band);
  std::swap(lists.touching, workspace.before);
  Writer writer(scene, lists, workspace);
  for (const NewContact& pair : workspace.new_contacts) {
    writer.copy_until(pair.next);
    writer.put(pair);
  }
  writer.copy_until(static_cast<int>(workspace.before.count()));
  for (const ChangedBall& changed : workspace.changes) {
    link(scene, lists.touching, changed);
  }
}

}  // namespace cellcrush
