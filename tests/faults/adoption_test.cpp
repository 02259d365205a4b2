// Workers outlive a daemon that is killed, and the next one goes along with them.
#include <gmock/gmock.h>

#include <chrono>
#include <csignal>

#include "faults/fault_fixture.h"
#include "server/job_numbers.h"
#include "server/small_case.h"

namespace cellcrush::testing {
namespace {

class AdoptionTest : public FaultFixture {
 protected:
  // Starts a daemon, lets it run the case, and kills it once there are samples. The job's worker.
  pid_t run_and_kill(const v1::Case& submitted, std::string& job) {
    start_daemon({"--workers", "1"});
    auto client = this->client();
    job = create_with_samples(client, submitted, 10);
    const pid_t worker = client.worker_of(job);
    kill_daemon();
    return worker;
  }

  // The job's samples are those of a run of the same case that nothing disturbs.
  static void expect_every_sample_once(Client& client, const std::string& job) {
    const std::string undisturbed = client.create(case_of_seconds());
    EXPECT_TRUE(client.watch(undisturbed).status.ok());
    const auto expected = client.history(undisturbed);
    const auto history = client.history(job);
    ASSERT_EQ(history.size(), expected.size());
    for (std::size_t i = 0; i < history.size(); ++i)
      EXPECT_EQ(history[i].SerializeAsString(), expected[i].SerializeAsString()) << i;
  }
};

TEST_F(AdoptionTest, AWorkerOutlivesItsDaemonAndTheNextOneGoesAlongWithIt) {
  std::string job;
  const pid_t worker = run_and_kill(case_of_seconds(), job);
  EXPECT_TRUE(is_alive(worker));
  start_daemon({"--workers", "1"});
  auto client = this->client();
  const auto now = client.get(job);
  EXPECT_TRUE(now.state() == v1::Job::RUNNING || now.state() == v1::Job::SUCCEEDED);
  expect_success(client, job);
  EXPECT_EQ(client.get(job).attempt(), 1);
  expect_every_sample_once(client, job);
  EXPECT_TRUE(wait_until_gone(worker, std::chrono::seconds(2)));
}

TEST_F(AdoptionTest, WhatAWorkerFinishedWhileThereWasNoDaemonCounts) {
  std::string job;
  const pid_t worker = run_and_kill(case_of_seconds(), job);
  ASSERT_TRUE(wait_until_gone(worker, std::chrono::seconds(60)));
  start_daemon({"--workers", "1"});
  auto client = this->client();
  EXPECT_EQ(client.get(job).state(), v1::Job::SUCCEEDED) << "At once: nothing is to be run.";
  EXPECT_EQ(client.get(job).attempt(), 1);
  expect_every_sample_once(client, job);
}

TEST_F(AdoptionTest, AnAdoptedWorkerHeedsACancel) {
  std::string job;
  const pid_t worker = run_and_kill(endless_case(), job);
  ASSERT_TRUE(is_alive(worker));
  start_daemon({"--workers", "1"});
  auto client = this->client();
  EXPECT_EQ(client.get(job).worker_pid(), worker);
  ASSERT_TRUE(client.cancel(job).ok());
  ASSERT_TRUE(client.wait_for_state(job, v1::Job::CANCELLED));
  EXPECT_TRUE(client.get(job).has_summary());
  EXPECT_TRUE(wait_until_gone(worker, std::chrono::seconds(2)));
  const std::string next = client.create(small_case());
  expect_success(client, next);
}

}  // namespace
}  // namespace cellcrush::testing
