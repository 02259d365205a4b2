#include "jobs/waiting_jobs.h"

#include <gtest/gtest.h>

namespace cellcrush::jobs {
namespace {

TEST(WaitingJobs, TheOldestComesFirst) {
  WaitingJobs waiting;
  for (const std::int64_t job : {3, 4, 5}) waiting.add(job, {});
  for (const std::int64_t job : {3, 4, 5}) EXPECT_EQ(waiting.take()->job, job);
  EXPECT_FALSE(waiting.take());
}

TEST(WaitingJobs, ASweepAtItsLimitLetsOthersPass) {
  WaitingJobs waiting;
  const WaitingJobs::Membership limited{1, 2};
  for (const std::int64_t job : {1, 2, 3}) waiting.add(job, limited);
  waiting.add(4, {2, 0});
  waiting.add(5, {2, 0});
  const auto first = waiting.take();
  EXPECT_EQ(first->job, 1);
  EXPECT_EQ(waiting.take()->job, 2);
  EXPECT_EQ(waiting.take()->job, 4);
  EXPECT_EQ(waiting.take()->job, 5);
  EXPECT_FALSE(waiting.take());
  waiting.give_back(*first);
  EXPECT_EQ(waiting.take()->job, 3);
}

}  // namespace
}  // namespace cellcrush::jobs
