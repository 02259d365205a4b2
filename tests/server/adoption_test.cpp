// Workers outlive a daemon that is killed, and the next one goes along with them.
#include <gmock/gmock.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <thread>

#include "server/daemon_fixture.h"
#include "server/daemon_process.h"
#include "server/job_numbers.h"
#include "server/small_case.h"
#include "worker/claim.h"

namespace cellcrush::testing {
namespace {

class AdoptionTest : public ::testing::Test {
 protected:
  void TearDown() override { kill_workers(folder_.path() / "data"); }

  [[nodiscard]] std::string socket() const { return "unix:" + (folder_.path() / "socket").string(); }
  [[nodiscard]] std::vector<std::string> arguments() const {
    return {"--data", (folder_.path() / "data").string(), "--listen", socket(), "--workers", "1"};
  }

  // Starts a daemon, lets it run the case, and kills it once there are samples. The job's worker.
  pid_t run_and_kill(const v1::Case& submitted, std::string& job) const {
    DaemonProcess daemon(arguments());
    EXPECT_EQ(daemon.wait_for_addresses(1).size(), 1U);
    Client client(socket());
    job = client.create(submitted);
    wait_for_samples(client, job, 10);
    const pid_t worker = client.worker_of(job);
    daemon.send_signal(SIGKILL);
    EXPECT_EQ(daemon.wait(), -1 - SIGKILL);
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

  TemporaryFolder folder_;
};

TEST_F(AdoptionTest, AWorkerOutlivesItsDaemonAndTheNextOneGoesAlongWithIt) {
  std::string job;
  const pid_t worker = run_and_kill(case_of_seconds(), job);
  EXPECT_TRUE(is_alive(worker));
  DaemonProcess daemon(arguments());
  ASSERT_EQ(daemon.wait_for_addresses(1).size(), 1U);
  Client client(socket());
  const auto now = client.get(job);
  EXPECT_TRUE(now.state() == v1::Job::RUNNING || now.state() == v1::Job::SUCCEEDED);
  EXPECT_TRUE(client.watch(job).status.ok());
  EXPECT_EQ(client.get(job).state(), v1::Job::SUCCEEDED) << client.get(job).cause_message();
  EXPECT_EQ(client.get(job).attempt(), 1);
  expect_every_sample_once(client, job);
  EXPECT_TRUE(wait_until_gone(worker, std::chrono::seconds(2)));
}

TEST_F(AdoptionTest, WhatAWorkerFinishedWhileThereWasNoDaemonCounts) {
  std::string job;
  const pid_t worker = run_and_kill(case_of_seconds(), job);
  ASSERT_TRUE(wait_until_gone(worker, std::chrono::seconds(60)));
  DaemonProcess daemon(arguments());
  ASSERT_EQ(daemon.wait_for_addresses(1).size(), 1U);
  Client client(socket());
  EXPECT_EQ(client.get(job).state(), v1::Job::SUCCEEDED) << "At once: nothing is to be run.";
  EXPECT_EQ(client.get(job).attempt(), 1);
  expect_every_sample_once(client, job);
}

TEST_F(AdoptionTest, AWorkerThatWentWhileThereWasNoDaemonIsReplaced) {
  std::string job;
  const pid_t worker = run_and_kill(case_of_seconds(), job);
  kill(worker, SIGKILL);
  ASSERT_TRUE(wait_until_gone(worker, std::chrono::seconds(5)));
  DaemonProcess daemon(arguments());
  ASSERT_EQ(daemon.wait_for_addresses(1).size(), 1U);
  Client client(socket());
  EXPECT_TRUE(client.watch(job).status.ok());
  EXPECT_EQ(client.get(job).state(), v1::Job::SUCCEEDED) << client.get(job).cause_message();
  EXPECT_EQ(client.get(job).attempt(), 2);
  expect_every_sample_once(client, job);
}

TEST_F(AdoptionTest, AnAdoptedWorkerHeedsACancel) {
  std::string job;
  const pid_t worker = run_and_kill(endless_case(), job);
  ASSERT_TRUE(is_alive(worker));
  DaemonProcess daemon(arguments());
  ASSERT_EQ(daemon.wait_for_addresses(1).size(), 1U);
  Client client(socket());
  EXPECT_EQ(client.get(job).worker_pid(), worker);
  ASSERT_TRUE(client.cancel(job).ok());
  ASSERT_TRUE(client.wait_for_state(job, v1::Job::CANCELLED));
  EXPECT_TRUE(client.get(job).has_summary());
  EXPECT_TRUE(wait_until_gone(worker, std::chrono::seconds(2)));
  const std::string next = client.create(small_case());
  EXPECT_TRUE(client.watch(next).status.ok());
  EXPECT_EQ(client.get(next).state(), v1::Job::SUCCEEDED) << "Its core is free again.";
}

}  // namespace
}  // namespace cellcrush::testing
