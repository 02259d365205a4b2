#include "fracture/new_ends.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include "contact/start_overlaps.h"
#include "contact/thickening.h"
#include "contact/touch/force_laws.h"

namespace cellcrush {
namespace {

class NewEnds {
 public:
  NewEnds(const Scene& before, std::span<const FailedEnd> ends, const Scene& after, const State& state)
      : before_(before), after_(after), state_(state), more_(static_cast<int>(ends.size())) {
    for (const FailedEnd& end : ends) {
      from_.push_back((end.at_end ? before.walls.end : before.walls.start)[end.wall]);
    }
  }

  /// Number after the breaks of a particle that was there before.
  [[nodiscard]] int number_of(int particle) const { return particle + (particle >= before_.joint_count ? more_ : 0); }

  /// Adds an overlap of before, for each chain that its segments belong to now.
  void keep(StartOverlap pair, std::vector<StartOverlap>& overlaps) const {
    pair.ball = number_of(pair.ball);
    overlaps.push_back(pair);
    for (int e = pair.first_segment; e < pair.end_segment && pair.chain >= 0; ++e) {
      if (before_.chain[e] == pair.chain && after_.chain[e] != overlaps.back().chain) {
        overlaps.push_back(pair);
        overlaps.back().chain = after_.chain[e];
      }
    }
  }

  /// Adds what lies near a new end to the overlaps.
  void add_near(int joint, std::vector<StartOverlap>& overlaps) const {
    const Vector2 place = state_.position[joint];
    const double reach = 4.0 * after_.greatest_radius();
    std::vector<int> balls;
    for (std::size_t i = 0; i < before_.particle_count(); ++i) {
      if ((state_.position[i] - place).norm() < reach) balls.push_back(number_of(static_cast<int>(i)));
    }
    for (std::size_t k = 0; k < from_.size(); ++k) {
      if ((state_.position[from_[k]] - place).norm() < reach)
        balls.push_back(before_.joint_count + static_cast<int>(k));
    }
    for (std::size_t e = 0; e < after_.element_count(); ++e) {
      const auto segment = static_cast<int>(e);
      if (distance_to(segment, place) >= reach) continue;
      for (const int ball : balls) add_pair(ball, segment, overlaps);
    }
  }

 private:
  /// Number before the breaks: of a new end, that of the joint from which it parts.
  [[nodiscard]] int number_before(int particle) const {
    if (particle < before_.joint_count) return particle;
    const int added = particle - before_.joint_count;
    return added < more_ ? from_[added] : particle - more_;
  }

  [[nodiscard]] double distance_to(int segment, const Vector2& place) const {
    const Vector2& start = state_.position[before_.elements[segment].start];
    return project(place, start, state_.axis[segment], state_.length[segment]).offset.norm();
  }

  void add_pair(int ball, int segment, std::vector<StartOverlap>& overlaps) const {
    const Element& element = after_.elements[segment];
    const bool is_joined = ball == element.start || ball == element.end;
    if (is_joined || after_.incidence_offset[ball] == after_.incidence_offset[ball + 1]) return;
    const int was = number_before(ball);
    const Element& earlier = before_.elements[segment];
    const double distance = distance_to(segment, state_.position[was]);
    const double full =
        after_.radius[ball] + growth_of_ball(state_, was) + half_thickness_now(before_, state_, segment);
    const double reach = std::min(full, after_.most_reach_of(ball, segment));
    const bool was_joined = was == earlier.start || was == earlier.end;
    // Not 0, which a list takes for an empty entry.
    constexpr double kLeastReach = 1e-9;
    const double limit = was_joined ? std::max(kKeptDistance * distance, kLeastReach * full)
                                    : most_reach_now(before_, state_, was, segment);
    if (distance >= reach || limit >= reach) return;
    const int chain = after_.chain[segment];
    const int own = after_.chain[after_.incidence[after_.incidence_offset[ball]]];
    StartOverlap pair = {ball, own, chain, segment, segment, segment + 1, 1, -1, limit};
    if (own != chain) {
      const auto is_of_chain = [chain](int of) { return of == chain; };
      pair.first_segment = static_cast<int>(std::ranges::find_if(after_.chain, is_of_chain) - after_.chain.begin());
      pair.end_segment =
          static_cast<int>(after_.chain.rend() - std::find_if(after_.chain.rbegin(), after_.chain.rend(), is_of_chain));
      pair.chain = chain;
    }
    overlaps.push_back(pair);
  }

  const Scene& before_;
  const Scene& after_;
  const State& state_;
  int more_;
  std::vector<int> from_;  ///< joint of each end
};

/// Of pairs of the same ball and the same segments the least reach.
void keep_least(std::vector<StartOverlap>& overlaps) {
  std::ranges::stable_sort(overlaps, [](const StartOverlap& a, const StartOverlap& b) {
    return std::tie(a.ball, a.chain, a.first_segment, a.end_segment, a.reach) <
           std::tie(b.ball, b.chain, b.first_segment, b.end_segment, b.reach);
  });
  const auto same = [](const StartOverlap& a, const StartOverlap& b) {
    return a.ball == b.ball && a.chain == b.chain && a.first_segment == b.first_segment &&
           a.end_segment == b.end_segment;
  };
  overlaps.erase(std::ranges::unique(overlaps, same).begin(), overlaps.end());
}

}  // namespace

void limit_new_ends(const Scene& before, std::span<const FailedEnd> ends, Scene& after, State& state) {
  if (!after.contact.present) return;
  const NewEnds new_ends(before, ends, after, state);
  std::vector<StartOverlap> overlaps;
  for (std::size_t p = 0; p < before.start_overlaps.pairs.size(); ++p) {
    if (state.parted[p] == 0) new_ends.keep(before.start_overlaps.pairs[p], overlaps);
  }
  for (const FailedEnd& end : ends) {
    new_ends.add_near((end.at_end ? before.walls.end : before.walls.start)[end.wall], overlaps);
  }
  keep_least(overlaps);
  state.parted.assign(overlaps.size(), 0);
  put_overlaps(std::move(overlaps), after);
}

void put_overlaps(std::vector<StartOverlap> pairs, Scene& scene) {
  StartOverlaps& overlaps = scene.start_overlaps;
  overlaps = {};
  if (pairs.empty()) return;
  overlaps.offset.assign(scene.particle_count() + 1, 0);
  for (const StartOverlap& pair : pairs) ++overlaps.offset[pair.ball + 1];
  std::partial_sum(overlaps.offset.begin(), overlaps.offset.end(), overlaps.offset.begin());
  overlaps.pairs = std::move(pairs);
}

}  // namespace cellcrush
