#include "jobs/queue_hold.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <new>
#include <system_error>

#include "error.h"

namespace cellcrush::jobs {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

class QueueHoldTest : public ::testing::Test {
 protected:
  static Trouble trouble(Shortage shortage) { return {shortage, std::string("No ") + name_of(shortage) + "."}; }

  // Starts a job as a slot does, once it may.
  bool try_to_start() { return hold_.is_open() && hold_.begin_start(); }

  Hold::Clock::time_point now_ = Hold::Clock::now();
  int changes_ = 0;
  QueueHold hold_{{seconds(1), seconds(8)}, [this](const std::vector<Hold>&) { ++changes_; }, [this] { return now_; }};
};

TEST_F(QueueHoldTest, ThePausesDoubleUpToTheLongestAndEachLetsOneJobTry) {
  hold_.failed(trouble(Shortage::descriptors));
  for (const int pause : {1, 2, 4, 8, 8}) {
    EXPECT_FALSE(hold_.is_open());
    EXPECT_EQ(*hold_.next_try() - now_, seconds(pause));
    now_ += seconds(pause) - milliseconds(1);
    EXPECT_FALSE(hold_.is_open());
    now_ += milliseconds(1);
    EXPECT_TRUE(try_to_start());
    EXPECT_FALSE(hold_.is_open()) << "Only one tries.";
    hold_.failed(trouble(Shortage::descriptors));
  }
}

TEST_F(QueueHoldTest, ATrialThatSucceedsReleasesItAndOneThatIsWithdrawnLetsAnotherTry) {
  hold_.failed(trouble(Shortage::worker));
  now_ += seconds(1);
  ASSERT_TRUE(try_to_start());
  hold_.end_trial();
  ASSERT_TRUE(try_to_start());
  hold_.succeeded();
  EXPECT_TRUE(hold_.is_open());
  EXPECT_TRUE(hold_.holds().empty());
  EXPECT_EQ(changes_, 2);
}

TEST_F(QueueHoldTest, SlotsThatMeetItAtOnceCountOnce) {
  for (int i = 0; i < 16; ++i) hold_.failed(trouble(Shortage::descriptors));
  EXPECT_EQ(*hold_.next_try() - now_, seconds(1));
}

TEST_F(QueueHoldTest, WhatComesBackSoonWasNotOver) {
  hold_.failed(trouble(Shortage::full_disk));
  now_ += seconds(1);
  ASSERT_TRUE(try_to_start());
  hold_.succeeded();
  now_ += milliseconds(500);
  hold_.failed(trouble(Shortage::full_disk));
  EXPECT_EQ(*hold_.next_try() - now_, seconds(2));
  now_ += seconds(2);
  ASSERT_TRUE(try_to_start());
  hold_.succeeded();
  now_ += seconds(60);
  hold_.failed(trouble(Shortage::full_disk));
  EXPECT_EQ(*hold_.next_try() - now_, seconds(1)) << "That is another time.";
}

TEST_F(QueueHoldTest, AfterAJobThatRanToItsEndThePausesBeginAgain) {
  hold_.failed(trouble(Shortage::full_disk));
  now_ += seconds(1);
  ASSERT_TRUE(try_to_start());
  hold_.succeeded();
  hold_.proven();
  hold_.failed(trouble(Shortage::full_disk));
  EXPECT_EQ(*hold_.next_try() - now_, seconds(1));
}

TEST_F(QueueHoldTest, ItIsTriedBeforeThePauseIsOverWhereThereAreSigns) {
  hold_.failed(trouble(Shortage::full_disk));
  hold_.try_now(Shortage::descriptors);
  EXPECT_FALSE(hold_.is_open()) << "It is held for another shortage.";
  hold_.try_now(Shortage::full_disk);
  EXPECT_TRUE(try_to_start());
  EXPECT_EQ(changes_, 2);
}

TEST_F(QueueHoldTest, ALowDiskAndTroubleHoldItTogether) {
  hold_.failed(trouble(Shortage::journal));
  EXPECT_TRUE(hold_.set_low_disk("Too little room."));
  EXPECT_FALSE(hold_.set_low_disk("Too little room.")) << "That is no change.";
  ASSERT_EQ(hold_.holds().size(), 2U);
  EXPECT_EQ(hold_.holds()[0].shortage, Shortage::low_disk);
  EXPECT_EQ(hold_.holds()[1].shortage, Shortage::journal);
  now_ += seconds(10);
  EXPECT_FALSE(hold_.is_open());
  hold_.set_low_disk(std::nullopt);
  EXPECT_TRUE(hold_.is_open());
}

TEST(Shortages, AreFoundBehindExceptions) {
  EXPECT_EQ(trouble_of(std::bad_alloc()).shortage, Shortage::memory);
  EXPECT_EQ(trouble_of(std::system_error(EMFILE, std::generic_category())).shortage, Shortage::descriptors);
  EXPECT_EQ(trouble_of(ServiceError(Shortage::journal, "locked")).shortage, Shortage::journal);
  EXPECT_EQ(ServiceError(Shortage::journal, "locked").kind(), ServiceError::Kind::unavailable);
  EXPECT_EQ(ServiceError(Shortage::full_disk, "full").kind(), ServiceError::Kind::storage_full);
  EXPECT_FALSE(trouble_of(std::logic_error("a bug")));
  EXPECT_FALSE(trouble_of(ServiceError(ServiceError::Kind::data_loss, "damaged")));
}

TEST(Shortages, HaveAnExitCodeEachARemedyAndAName) {
  for (const Shortage shortage : kShortages) {
    EXPECT_STRNE(name_of(shortage), "none");
    EXPECT_GT(std::string(remedy_for(shortage)).size(), 10U);
  }
  for (const int error : {ENOSPC, EDQUOT}) EXPECT_EQ(shortage_of_errno(error), Shortage::full_disk);
  for (const int error : {EACCES, EROFS, EIO}) EXPECT_EQ(shortage_of_errno(error), Shortage::data_folder);
  for (const int error : {ENOMEM, EAGAIN}) EXPECT_EQ(shortage_of_errno(error), Shortage::memory);
  EXPECT_EQ(shortage_of_errno(EINVAL), Shortage::none);
}

}  // namespace
}  // namespace cellcrush::jobs
