#include "jobs/queue_forecast.h"

#include <gmock/gmock.h>

#include <chrono>

namespace cellcrush::jobs {
namespace {

// A second is 1000 element-steps.
constexpr double kStepCost = 1e-3;

store::QueuedJob lasting(std::int64_t job, std::int64_t seconds, const std::string& owner = "") {
  return {job, job, 0, 1000 * seconds, 0, 0, owner};
}

store::QueuedJob of_sweep(std::int64_t job, std::int64_t seconds, int max_parallel) {
  return {job, 100, 0, 1000 * seconds, 9, max_parallel};
}

JobFacts plain(std::int64_t) { return {}; }

void expect_entry(const v1::Queue& queue, int at, const std::string& job, double seconds, const std::string& reason) {
  ASSERT_LT(at, queue.entries_size());
  EXPECT_EQ(queue.entries(at).job(), job);
  EXPECT_NEAR(queue.entries(at).seconds_until_start(), seconds, 1e-9) << job;
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
    return JobFacts{1, job == 1 ? 7'000 : 0};
  });
  expect_entry(queue, 1, "jobs/2", 3.0, "1 job starts before it.");
  EXPECT_EQ(predicted_seconds(lasting(1, 10), {1, 20'000}, 1, kStepCost), 0.0);
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
  for (int i = 1; i <= 20'000; ++i) waiting.push_back(lasting(i, 1 + i % 7));
  const auto start = std::chrono::steady_clock::now();
  const auto queue = forecast_queue({}, waiting, {4, kStepCost}, plain);
  EXPECT_EQ(queue.entries_size(), kMostEntries);
  EXPECT_EQ(queue.more_count(), 19'000);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(2));
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

}  // namespace
}  // namespace cellcrush::jobs
