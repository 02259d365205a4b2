#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <vector>

#include "scenes/every_target.h"
#include "touch/contact_stages.h"

namespace cellcrush {
namespace {

/// Travel of the group of a place: three groups take turns by batch; by buckets there is none.
double travel_at(const ContactLists& lists, std::size_t place) {
  return lists.batch_group.empty() ? 0.0 : lists.group_travel[place / kCandidateBatch % 3];
}

/// Every fifth of the candidates or so is awake; `awake` lists those from `first` on.
ContactLists some_candidates(std::size_t batches, bool by_faces, std::size_t first, std::mt19937& generator,
                             std::vector<int>& awake) {
  ContactLists lists;
  lists.group_travel = {1.0, 2.0, 3.0};
  for (std::size_t batch = 0; by_faces && batch < batches; ++batch) {
    lists.batch_group.push_back(static_cast<int>(batch % 3));
  }
  for (std::size_t place = 0; place < batches * kCandidateBatch; ++place) {
    const double travel = travel_at(lists, place);
    if (generator() % 5 == 0) {
      lists.candidate_next_check_travel.push_back(travel);
      if (place >= first) {
        awake.push_back(static_cast<int>(place));
      }
    } else {
      const double later = generator() % 2 == 0 ? travel + 0.1 : std::numeric_limits<double>::infinity();
      lists.candidate_next_check_travel.push_back(later);
    }
  }
  return lists;
}

TEST(AwakeCandidates, AreThoseWhoseNextCheckIsDue) {
  std::mt19937 generator(5);
  for (const bool by_faces : {true, false}) {
    for (const std::size_t batches : {0, 1, 3, 8, 9, 100}) {
      const std::size_t first = batches > 2 ? kCandidateBatch : 0;
      std::vector<int> awake;
      const ContactLists lists = some_candidates(batches, by_faces, first, generator, awake);
      scenes::for_every_target([&] {
        constexpr int kUntouched = -7;
        std::vector<int> places(awake.size() + kCandidateBatch + 1, kUntouched);
        const std::size_t end = lists.candidate_next_check_travel.size();
        const std::size_t count = find_awake_candidates(lists, first, end, places.data());
        EXPECT_EQ(places.back(), kUntouched);
        places.resize(count);
        EXPECT_EQ(places, awake);
      });
    }
  }
}

}  // namespace
}  // namespace cellcrush
