#include "jobs/waiting_jobs.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace cellcrush::jobs {
namespace {

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

TEST(WaitingJobs, AnOwnerAtTheLimitLetsOthersPass) {
  WaitingJobs waiting(2);
  for (const std::int64_t job : {1, 2, 3}) waiting.add(owned(job, "anna", 5));
  waiting.add(owned(4, "bob"));
  EXPECT_EQ(waiting.count_of("anna"), 3U);
  EXPECT_EQ(waiting.take()->job, 1);
  EXPECT_EQ(waiting.take()->job, 2);
  EXPECT_EQ(waiting.limit_of(owned(3, "anna")), WaitingJobs::Limit::owner);
  EXPECT_EQ(waiting.take()->job, 4);
  EXPECT_FALSE(waiting.take());
  waiting.give_back(owned(1, "anna"));
  EXPECT_EQ(waiting.take()->job, 3);
  EXPECT_EQ(waiting.count_of("anna"), 0U);
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

}  // namespace
}  // namespace cellcrush::jobs
