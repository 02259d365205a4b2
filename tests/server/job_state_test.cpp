#include "store/job_state.h"

#include <gtest/gtest.h>

#include <array>

namespace cellcrush::store {
namespace {

constexpr std::array kAll = {v1::Job::JOB_STATE_UNSPECIFIED,
                             v1::Job::PENDING,
                             v1::Job::RUNNING,
                             v1::Job::SUSPENDED,
                             v1::Job::CANCELLING,
                             v1::Job::SUCCEEDED,
                             v1::Job::FAILED,
                             v1::Job::CANCELLED};

TEST(JobState, NothingFollowsAnEnd) {
  for (const auto from : {v1::Job::SUCCEEDED, v1::Job::FAILED, v1::Job::CANCELLED}) {
    EXPECT_TRUE(is_terminal(from));
    for (const auto to : kAll) EXPECT_FALSE(may_follow(from, to)) << v1::Job::State_Name(to);
  }
}

TEST(JobState, EveryStateThatIsNoEndLeadsToOne) {
  for (const auto from : {v1::Job::PENDING, v1::Job::RUNNING, v1::Job::SUSPENDED, v1::Job::CANCELLING}) {
    EXPECT_FALSE(is_terminal(from));
    EXPECT_TRUE(may_follow(from, v1::Job::FAILED)) << v1::Job::State_Name(from);
    EXPECT_FALSE(may_follow(from, from)) << v1::Job::State_Name(from);
  }
}

TEST(JobState, OnlyARunSucceeds) {
  EXPECT_TRUE(may_follow(v1::Job::PENDING, v1::Job::RUNNING));
  EXPECT_TRUE(may_follow(v1::Job::RUNNING, v1::Job::SUCCEEDED));
  EXPECT_FALSE(may_follow(v1::Job::PENDING, v1::Job::SUCCEEDED));
  EXPECT_FALSE(may_follow(v1::Job::SUSPENDED, v1::Job::SUCCEEDED));
}

}  // namespace
}  // namespace cellcrush::store
