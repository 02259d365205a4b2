#include "store/job_state.h"

#include <gtest/gtest.h>

#include <array>

namespace cellcrush::store {
namespace {

constexpr std::array kAll = {v1::JOB_STATE_UNSPECIFIED,
                             v1::PENDING,
                             v1::RUNNING,
                             v1::SUSPENDED,
                             v1::CANCELLING,
                             v1::SUCCEEDED,
                             v1::FAILED,
                             v1::CANCELLED};

TEST(JobState, NothingFollowsAnEnd) {
  for (const auto from : {v1::SUCCEEDED, v1::FAILED, v1::CANCELLED}) {
    EXPECT_TRUE(is_terminal(from));
    for (const auto to : kAll) EXPECT_FALSE(may_follow(from, to)) << v1::JobState_Name(to);
  }
}

TEST(JobState, EveryStateThatIsNoEndLeadsToOne) {
  for (const auto from : {v1::PENDING, v1::RUNNING, v1::SUSPENDED, v1::CANCELLING}) {
    EXPECT_FALSE(is_terminal(from));
    EXPECT_TRUE(may_follow(from, v1::FAILED)) << v1::JobState_Name(from);
    EXPECT_FALSE(may_follow(from, from)) << v1::JobState_Name(from);
  }
}

TEST(JobState, OnlyARunSucceeds) {
  EXPECT_TRUE(may_follow(v1::PENDING, v1::RUNNING));
  EXPECT_TRUE(may_follow(v1::RUNNING, v1::SUCCEEDED));
  EXPECT_FALSE(may_follow(v1::PENDING, v1::SUCCEEDED));
  EXPECT_FALSE(may_follow(v1::SUSPENDED, v1::SUCCEEDED));
}

}  // namespace
}  // namespace cellcrush::store
