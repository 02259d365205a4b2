#include "jobs/queue_forecast.h"

#include <gmock/gmock.h>

#include <chrono>

namespace cellcrush::jobs {
namespace {

// A second is 1000 element-steps.
constexpr double kStepCost = 1e-3;

store::QueuedJob lasting(std::int64_t job, std::int64_t seconds) { return {job, job, 0, 1000 * seconds, 0, 0}; }

store::QueuedJob of_sweep(std::int64_t job, std::int64_t seconds, int max_parallel) {
  return {job, 100, 0, 1000 * seconds, 9, max_parallel};
}

void expect_entry(const v1::Queue& queue, int at, const std::string& job, double seconds, const std::string& reason) {
  ASSERT_LT(at, queue.entries_size());
  EXPECT_EQ(queue.entries(at).job(), job);
  EXPECT_NEAR(queue.entries(at).seconds_until_start(), seconds, 1e-9) << job;
  EXPECT_EQ(queue.entries(at).reason(), reason) << job;
}

TEST(QueueForecast, JobsStartWhenThoseThatRunAndThoseBeforeThemHaveEnded) {
  const auto queue = forecast_queue({{lasting(1, 100), 5.0}, {lasting(2, 100), 20.0}},
                                    {lasting(3, 10), lasting(4, 1), lasting(5, 1)}, {2, kStepCost});
  ASSERT_EQ(queue.entries_size(), 3);
  expect_entry(queue, 0, "jobs/3", 5.0, "All 2 workers are busy.");
  expect_entry(queue, 1, "jobs/4", 15.0, "All 2 workers are busy, and 1 job starts before it.");
  expect_entry(queue, 2, "jobs/5", 16.0, "All 2 workers are busy, and 2 jobs start before it.");
  EXPECT_EQ(queue.more_count(), 0);
}

TEST(QueueForecast, ASweepAtItsLimitSaysSoAndOthersPassIt) {
  const auto queue = forecast_queue({{of_sweep(101, 50, 1), 50.0}},
                                    {of_sweep(102, 10, 1), of_sweep(103, 20, 1), lasting(200, 5)}, {2, kStepCost});
  ASSERT_EQ(queue.entries_size(), 3);
  expect_entry(queue, 0, "jobs/200", 0.0, "A worker takes it now.");
  const std::string limit = "Its sweep, sweeps/9, already runs the 1 job that max_parallel allows, and ";
  expect_entry(queue, 1, "jobs/103", 50.0, limit + "1 job starts before it.");
  expect_entry(queue, 2, "jobs/102", 70.0, limit + "2 jobs start before it.");
}

TEST(QueueForecast, WithWorkersFreeAJobWaitsForThoseBeforeItAlone) {
  const auto queue = forecast_queue({}, {lasting(1, 7), lasting(2, 1)}, {1, kStepCost});
  expect_entry(queue, 0, "jobs/1", 0.0, "A worker takes it now.");
  expect_entry(queue, 1, "jobs/2", 7.0, "1 job starts before it.");
  EXPECT_EQ(forecast_queue({{lasting(1, 1), 1.0}}, {lasting(2, 1)}, {1, kStepCost}).entries(0).reason(),
            "The only worker is busy.");
}

TEST(QueueForecast, APriorityIsToldAndComesFirst) {
  auto urgent = lasting(3, 1);
  urgent.priority = 5;
  const auto queue = forecast_queue({{lasting(1, 1), 2.0}}, {lasting(2, 1), urgent}, {1, kStepCost});
  expect_entry(queue, 0, "jobs/3", 2.0, "The only worker is busy.");
  EXPECT_EQ(queue.entries(0).priority(), 5);
  expect_entry(queue, 1, "jobs/2", 3.0, "The only worker is busy, and 1 job starts before it.");
}

TEST(QueueForecast, AnEmptyQueueHasNoEntries) {
  EXPECT_EQ(forecast_queue({{lasting(1, 1), 1.0}}, {}, {1, kStepCost}).entries_size(), 0);
  EXPECT_EQ(forecast_queue({}, {}, {1, kStepCost}).entries_size(), 0);
}

TEST(QueueForecast, AFullQueueIsCutAtAThousandEntriesAndCountsTheRest) {
  std::vector<store::QueuedJob> waiting;
  for (int i = 1; i <= 20'000; ++i) waiting.push_back(lasting(i, 1 + i % 7));
  const auto start = std::chrono::steady_clock::now();
  const auto queue = forecast_queue({}, waiting, {4, kStepCost});
  EXPECT_EQ(queue.entries_size(), kMostEntries);
  EXPECT_EQ(queue.more_count(), 19'000);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(2));
}

}  // namespace
}  // namespace cellcrush::jobs
