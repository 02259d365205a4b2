// What waits, in which order and why: the lists, the forecast and the hold of a queue.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cerrno>
#include <chrono>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#include "error.h"
#include "jobs/queue_forecast.h"
#include "jobs/queue_hold.h"
#include "jobs/waiting_jobs.h"

namespace cellcrush::jobs {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

store::QueuedJob alone(std::int64_t job, int priority = 0) {
  store::QueuedJob out{job, job};
  out.priority = priority;
  return out;
}

store::QueuedJob in_sweep(std::int64_t job, std::int64_t sweep, std::int64_t submission, int max_parallel,
                          std::int64_t element_steps = 0) {
  return {job, submission, 0, element_steps, sweep, max_parallel};
}

store::QueuedJob owned(std::int64_t job, const std::string& owner, int priority = 0) {
  store::QueuedJob out = alone(job, priority);
  out.owner = owner;
  return out;
}

std::vector<std::int64_t> order_of(WaitingJobs waiting) {
  std::vector<std::int64_t> out;
  while (const auto job = waiting.take()) out.push_back(job->job);
  return out;
}

TEST(WaitingJobs, ALongJobOfAYoungerSubmissionDoesNotPassAnOlderOne) {
  WaitingJobs waiting;
  waiting.add(in_sweep(1, 1, 1, 0, 10));
  waiting.add(in_sweep(2, 1, 1, 0, 20));
  waiting.add(alone(3));
  waiting.add(in_sweep(4, 2, 4, 0, 1000));
  waiting.add(in_sweep(5, 1, 5, 0, 2000));  // retried
  EXPECT_EQ(order_of(waiting), (std::vector<std::int64_t>{2, 1, 3, 4, 5}));
}

TEST(WaitingJobs, AJobThatRunsAlreadyCountsForItsSweep) {
  WaitingJobs waiting;
  waiting.count_running(in_sweep(1, 1, 1, 1));
  waiting.add(in_sweep(2, 1, 1, 1));
  EXPECT_FALSE(waiting.take());
  waiting.give_back(in_sweep(1, 1, 1, 1));
  EXPECT_EQ(waiting.take()->job, 2);
}

TEST(WaitingJobs, OfEqualPriorityTheOwnerWithTheFewestCoresComesNext) {
  WaitingJobs waiting;
  for (const std::int64_t job : {1, 2, 3, 4}) waiting.add(owned(job, "anna"));
  for (const std::int64_t job : {5, 6}) waiting.add(owned(job, "bob"));
  waiting.add(owned(7, "carl"));
  EXPECT_EQ(order_of(waiting), (std::vector<std::int64_t>{1, 5, 7, 2, 6, 3, 4}));
  waiting.add(owned(8, "anna", 1));
  EXPECT_EQ(waiting.take()->job, 8) << "The priority comes first.";
  EXPECT_EQ(waiting.take()->job, 5);
  waiting.add_cores(owned(5, "bob"), 2);
  EXPECT_EQ(waiting.take()->job, 7);
  EXPECT_EQ(waiting.take()->job, 1) << "Bob's job holds three cores.";
  waiting.give_back(owned(5, "bob"), 3);
  EXPECT_EQ(waiting.take()->job, 6);
}

TEST(WaitingJobs, OneThatIsRemovedIsCountedNoMore) {
  WaitingJobs waiting;
  for (const std::int64_t job : {1, 2, 3}) waiting.add(in_sweep(job, 1, 1, 0));
  waiting.add(owned(4, "bob"));
  waiting.remove(2);
  waiting.remove(2);
  waiting.remove(99);
  EXPECT_EQ(waiting.count(), 3U);
  EXPECT_EQ(waiting.count_of(""), 2U);
  EXPECT_EQ(order_of(waiting), (std::vector<std::int64_t>{1, 4, 3}));
}

// A second is 1000 element-steps.
constexpr double kStepCost = 1e-3;

store::QueuedJob lasting(std::int64_t job, std::int64_t time_s, const std::string& owner = "") {
  return {job, job, 0, 1000 * time_s, 0, 0, owner};
}

store::QueuedJob of_sweep(std::int64_t job, std::int64_t time_s, int max_parallel) {
  return {job, 100, 0, 1000 * time_s, 9, max_parallel};
}

JobFacts plain(std::int64_t) { return {}; }

void expect_entry(const v1::Queue& queue, int at, const std::string& job, double time_s, const std::string& reason) {
  ASSERT_LT(at, queue.entries_size());
  EXPECT_EQ(queue.entries(at).job(), job);
  EXPECT_NEAR(queue.entries(at).seconds_until_start(), time_s, 1e-9) << job;
  EXPECT_EQ(queue.entries(at).reason(), reason) << job;
}

TEST(QueueForecast, JobsStartWhenThoseThatRunAndThoseBeforeThemHaveEnded) {
  const auto queue = forecast_queue({{lasting(1, 100), 5.0}, {lasting(2, 100), 20.0}},
                                    {lasting(3, 10), lasting(4, 1), lasting(5, 1)}, {2, kStepCost}, plain);
  ASSERT_EQ(queue.entries_size(), 3);
  expect_entry(queue, 0, "jobs/3", 5.0, "All 2 workers are busy.");
  expect_entry(queue, 1, "jobs/4", 15.0, "All 2 workers are busy, and 1 job starts before it.");
  expect_entry(queue, 2, "jobs/5", 16.0, "All 2 workers are busy, and 2 jobs start before it.");
  EXPECT_EQ(queue.more_count(), 0);
}

TEST(QueueForecast, ASweepAtItsLimitSaysSoAndOthersPassIt) {
  const auto queue =
      forecast_queue({{of_sweep(101, 50, 1), 50.0}}, {of_sweep(102, 10, 1), of_sweep(103, 20, 1), lasting(200, 5)},
                     {2, kStepCost}, plain);
  ASSERT_EQ(queue.entries_size(), 3);
  expect_entry(queue, 0, "jobs/200", 0.0, "A worker is starting it now.");
  const std::string limit = "Its sweep, sweeps/9, is already running the 1 job that max_parallel allows, and ";
  expect_entry(queue, 1, "jobs/103", 50.0, limit + "1 job starts before it.");
  expect_entry(queue, 2, "jobs/102", 70.0, limit + "2 jobs start before it.");
}

TEST(QueueForecast, AJobWithThreadsHoldsSoManyCoresAndTakesLess) {
  const auto queue = forecast_queue({{lasting(1, 100), 8.0, 2}}, {lasting(2, 10), lasting(3, 1)}, {4, kStepCost},
                                    [](std::int64_t job) {
                                      return JobFacts{job == 2 ? 8 : 1, 0};
                                    });
  ASSERT_EQ(queue.entries_size(), 2);
  expect_entry(queue, 0, "jobs/2", 0.0, "A worker is starting it now.");
  expect_entry(queue, 1, "jobs/3", 0.0, "A worker is starting it now.");

  // Of three free cores one is left to the job that waits behind it; the next comes when two end.
  const auto more = forecast_queue({{lasting(1, 100), 9.0, 1}}, {lasting(2, 10), lasting(3, 60), lasting(4, 1)},
                                   {4, kStepCost}, [](std::int64_t job) {
                                     return JobFacts{job == 2 ? 8 : 1, 0};
                                   });
  ASSERT_EQ(more.entries_size(), 3);
  EXPECT_EQ(more.entries(2).seconds_until_start(), 0.0);

  const auto alone = forecast_queue({}, {lasting(1, 10)}, {2, kStepCost}, [](std::int64_t) { return JobFacts{2, 0}; });
  EXPECT_EQ(alone.entries(0).seconds_until_start(), 0.0);
  const auto behind =
      forecast_queue({{lasting(1, 100), 5.0, 2}}, {lasting(2, 10), lasting(3, 10)}, {2, kStepCost}, plain);
  expect_entry(behind, 0, "jobs/2", 5.0, "All 2 workers are busy.");
  expect_entry(behind, 1, "jobs/3", 5.0, "All 2 workers are busy, and 1 job starts before it.");
  EXPECT_NEAR(predicted_seconds(lasting(1, 10), {2, 0}, 2, kStepCost), 8.0, 1e-9);
  EXPECT_EQ(extra_cores(8, 3, 1), 2);
  EXPECT_EQ(extra_cores(8, 3, 5), 0);
  EXPECT_EQ(extra_cores(2, 3, 0), 1);
}

TEST(QueueForecast, WhatWasDoneBeforeAJobWasLeftIsTakenOff) {
  const auto queue = forecast_queue({}, {lasting(1, 10), lasting(2, 1)}, {1, kStepCost}, [](std::int64_t job) {
    return JobFacts{1, job == 1 ? 0.7 : 0.0};
  });
  expect_entry(queue, 1, "jobs/2", 3.0, "1 job starts before it.");
  EXPECT_EQ(predicted_seconds(lasting(1, 10), {1, 1.2}, 1, kStepCost), 0.0);
}

TEST(QueueForecast, OwnersTakeTurnsAndOneAtTheLimitSaysSo) {
  const std::vector<store::QueuedJob> waiting = {lasting(2, 10, "anna"), lasting(3, 10, "anna"), lasting(4, 10, "bob")};
  const auto queue = forecast_queue({{lasting(1, 100, "anna"), 5.0, 2}}, waiting, {4, kStepCost}, plain);
  ASSERT_EQ(queue.entries_size(), 3);
  expect_entry(queue, 0, "jobs/4", 0.0, "A worker is starting it now.");
  expect_entry(queue, 1, "jobs/2", 0.0, "A worker is starting it now.");
  WorkerFacts limited{4, kStepCost};
  limited.owner_max_running = 1;
  const auto held = forecast_queue({{lasting(1, 100, "anna"), 5.0}}, waiting, limited, plain);
  expect_entry(held, 0, "jobs/4", 0.0, "A worker is starting it now.");
  const std::string limit = "Its owner, anna, is already running the 1 job that --owner-max-running allows, and ";
  expect_entry(held, 1, "jobs/2", 5.0, limit + "1 job starts before it.");
  expect_entry(held, 2, "jobs/3", 15.0, limit + "2 jobs start before it.");
}

TEST(QueueForecast, AFullQueueIsCutAtAThousandEntriesAndCountsTheRest) {
  std::vector<store::QueuedJob> waiting;
  for (int i = 1; i <= 200'000; ++i) waiting.push_back(lasting(i, 1 + i % 7));
  const auto queue = forecast_queue({}, waiting, {4, kStepCost}, plain);
  EXPECT_EQ(queue.entries_size(), kMostEntries);
  EXPECT_EQ(queue.more_count(), 199'000);
}

TEST(QueueForecast, OnAClusterAJobHoldsOnePlaceWhateverItsThreads) {
  auto on_cluster = [](std::int64_t job) {
    auto out = lasting(job, 10);
    out.executor = "slurm/test";
    return out;
  };
  const WorkerFacts cluster{2, kStepCost, {}, 0, "slurm/test"};
  const auto queue =
      forecast_queue({{on_cluster(1), 4.0, 8}}, {on_cluster(2), on_cluster(3)}, cluster, [](std::int64_t) {
        return JobFacts{5, 0};
      });
  ASSERT_EQ(queue.entries_size(), 2);
  expect_entry(queue, 0, "jobs/2", 0.0, "slurm/test takes it now.");
  expect_entry(queue, 1, "jobs/3", 4.0, "1 job starts before it.");
  EXPECT_EQ(queue.entries(0).executor(), "slurm/test");

  const auto full = forecast_queue({{on_cluster(1), 4.0}, {on_cluster(2), 6.0}}, {on_cluster(3)}, cluster, plain);
  expect_entry(full, 0, "jobs/3", 4.0, "slurm/test has 2 jobs, as many as it may.");
}

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
