#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "contact/touch/contact_stages.h"
#include "parallel/workers.h"
#include "scenes/every_target.h"
#include "scenes/evidence.h"
#include "scenes/placed_pairs.h"

namespace cellcrush {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// All pairs as candidates of one group; places that fill the last batch are never tested.
ContactLists candidates_of(const std::vector<scenes::PlacedPair>& pairs, double travel) {
  ContactLists lists;
  const std::size_t batches = (pairs.size() + kCandidateBatch - 1) / kCandidateBatch;
  for (std::size_t i = 0; i < batches * kCandidateBatch; ++i) {
    const bool is_pair = i < pairs.size();
    lists.candidate_ball.push_back(is_pair ? static_cast<int>(3 * i + 2) : 0);
    lists.candidate_segment.push_back(is_pair ? static_cast<int>(i) : 0);
    lists.candidate_reach.push_back(is_pair ? pairs[i].reach : 0.0);
    lists.candidate_next_check_travel.push_back(is_pair ? 0.0 : kNever);
  }
  lists.batch_group.assign(batches, 0);
  lists.group_travel = {travel};
  return lists;
}

TEST(FindOverlaps, FindsWhatIsNearerThanItsReachAndWhenTheRestIsDue) {
  constexpr double kTravel = 3.0;
  const std::vector<scenes::PlacedPair> pairs = scenes::draw_pairs(333);
  const scenes::PairScene at(pairs);
  Workers workers(1);
  double worst = 0.0;
  scenes::for_every_target([&] {
    ContactLists lists = candidates_of(pairs, kTravel);
    ContactWorkspace workspace;
    workspace.parts.resize(1);
    find_overlaps(at.scene, at.state, lists, workspace, workers);
    std::vector<int> overlapping;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const double gap = pairs[i].distance() - pairs[i].reach;
      if (gap < 0.0) {
        overlapping.push_back(static_cast<int>(i));
        EXPECT_EQ(lists.candidate_next_check_travel[i], kNever) << i;
      } else {
        EXPECT_NEAR(lists.candidate_next_check_travel[i], kTravel + gap, 1e-12) << i;
        worst = std::max(worst, std::abs(lists.candidate_next_check_travel[i] - kTravel - gap));
      }
    }
    EXPECT_GT(overlapping.size(), pairs.size() / 4);
    EXPECT_LT(overlapping.size(), 3 * pairs.size() / 4);
    EXPECT_EQ(workspace.found, overlapping);
  });
  scenes::record_bound("gap error in mm", worst);
}

}  // namespace
}  // namespace cellcrush
