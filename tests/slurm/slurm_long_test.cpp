// Long trials: a daemon that is killed again and again, a controller that is away for minutes.
#include <algorithm>
#include <csignal>
#include <random>

#include "server/daemon_fixture.h"
#include "server/daemon_process.h"
#include "server/sweep_requests.h"
#include "slurm/slurm_fixture.h"

namespace cellcrush::testing {
namespace {

using Kind = jobs::WorkerExit::Kind;
using std::chrono::milliseconds;
using std::chrono::seconds;

class SlurmLongTest : public SlurmFixture {
 protected:
  [[nodiscard]] std::string socket() const { return "unix:" + (folder_.path() / "socket").string(); }
  [[nodiscard]] std::vector<std::string> arguments() const {
    return {"--data",
            (folder_.path() / "data").string(),
            "--listen",
            socket(),
            "--slurm",
            "test:folder=" + quick_options().folder.string() + ",task-length=0,program=" + logging_program().string(),
            "--executor",
            "slurm/test"};
  }

  // A sweep that takes two nodes about two minutes.
  static v1::CreateSweepRequest long_sweep() {
    std::vector<double> speeds;
    for (int i = 0; i < 30; ++i) speeds.push_back(0.3 + 0.01 * i);
    return sweep_of(case_of_seconds(), kSpeed, speeds);
  }

  // The samples of each point are those of a run on this machine that nothing disturbs.
  static void expect_undisturbed(Client& client, const v1::Sweep& sweep, v1::CreateSweepRequest request) {
    request.mutable_sweep()->set_executor("local");
    const auto here = create(client, request);
    ASSERT_TRUE(wait_for_all(client, here, seconds(1200)));
    const auto expected = get_sweep(client, here.name());
    for (int i = 0; i < sweep.jobs_size(); ++i) {
      const auto samples = client.history(sweep.jobs(i));
      const auto undisturbed = client.history(expected.jobs(i));
      ASSERT_EQ(samples.size(), undisturbed.size());
      for (std::size_t k = 0; k < samples.size(); ++k)
        ASSERT_EQ(samples[k].SerializeAsString(), undisturbed[k].SerializeAsString()) << sweep.jobs(i) << " " << k;
    }
  }

  static bool wait_for_all(Client& client, const v1::Sweep& sweep, seconds limit) {
    const auto end = std::chrono::steady_clock::now() + limit;
    while (std::chrono::steady_clock::now() < end) {
      if (count_in(get_sweep(client, sweep.name()), v1::Job::SUCCEEDED) == sweep.jobs_size()) return true;
      std::this_thread::sleep_for(seconds(1));
    }
    return false;
  }
};

TEST_F(SlurmLongTest, ADaemonKilledAtFiftyRandomMomentsLosesAndRepeatsNothing) {
  start_cluster();
  std::mt19937 random(7);
  std::uniform_int_distribution<int> pause(0, 2'500);
  v1::Sweep sweep;
  for (int i = 0; i < 50; ++i) {
    DaemonProcess daemon(arguments());
    ASSERT_EQ(daemon.wait_for_addresses(1).size(), 1U);
    if (i == 0) {
      Client client(socket());
      sweep = create(client, long_sweep());
    }
    std::this_thread::sleep_for(milliseconds(pause(random)));
    daemon.send_signal(SIGKILL);
    EXPECT_EQ(daemon.wait(), -1 - SIGKILL);
  }
  DaemonProcess daemon(arguments());
  ASSERT_EQ(daemon.wait_for_addresses(1).size(), 1U);
  Client client(socket());
  ASSERT_TRUE(wait_for_all(client, sweep, seconds(1200)));
  // No task computed a point again.
  EXPECT_EQ(count_in_log("begins"), sweep.jobs_size());
  EXPECT_EQ(count_in_log("has ended", sweep.jobs_size()), sweep.jobs_size());
  expect_undisturbed(client, get_sweep(client, sweep.name()), long_sweep());
}

TEST_F(SlurmLongTest, ASweepSurvivesAControllerThatIsAwayForTwoMinutes) {
  start_cluster();
  DaemonProcess daemon(arguments());
  ASSERT_EQ(daemon.wait_for_addresses(1).size(), 1U);
  Client client(socket());
  const auto sweep = create(client, long_sweep());
  std::this_thread::sleep_for(seconds(10));
  cluster_->stop_controller();
  const auto late = create(client, sweep_of(case_of_seconds(), kSpeed, {5.0, 6.0}));
  std::this_thread::sleep_for(seconds(120));
  cluster_->start_controller();
  ASSERT_TRUE(wait_for_all(client, sweep, seconds(1200)));
  ASSERT_TRUE(wait_for_all(client, late, seconds(1200)));
  const auto ended = get_sweep(client, sweep.name());
  for (const auto& job : ended.jobs()) EXPECT_EQ(client.get(job).attempt(), 1) << client.get(job).cause_message();
  expect_undisturbed(client, get_sweep(client, sweep.name()), long_sweep());
}

// As many as a cluster has at once by default. All of them are in Slurm before the first ones have ended.
TEST_F(SlurmLongTest, TwoHundredAndFiftySixJobsAreInTheClusterAtOnceAndComputedOnce) {
  start_cluster();
  DaemonProcess daemon(arguments());
  ASSERT_EQ(daemon.wait_for_addresses(1).size(), 1U);
  Client client(socket());
  std::vector<double> speeds;
  for (int i = 0; i < 256; ++i) speeds.push_back(20.0 + 0.1 * i);
  const auto sweep = create(client, sweep_of(tiny_case(), kSpeed, speeds));
  std::ptrdiff_t most = 0;
  for (int i = 0; i < 60 && most < 240; ++i) {
    const auto listed = cluster_->run({"squeue", "--noheader", "--array", "--format=%T"}).output;
    most = std::max(most, std::count(listed.begin(), listed.end(), '\n'));
    std::this_thread::sleep_for(milliseconds(500));
  }
  EXPECT_GE(most, 240);
  ASSERT_TRUE(wait_for_all(client, sweep, seconds(1200)));
  EXPECT_EQ(count_in_log("begins"), 256);
  EXPECT_EQ(count_in_log("has ended", 256), 256);
  const auto ended = get_sweep(client, sweep.name());
  for (const auto& job : ended.jobs()) EXPECT_EQ(client.get(job).attempt(), 1) << client.get(job).cause_message();
}

// A task of a minute: Slurm warns half a minute before.
TEST_F(SlurmLongTest, AJobThatIsLongerThanItsTaskContinuesInTheNextWithTheSameBits) {
  start_cluster();
  auto options = quick_options();
  options.longest = seconds(60);
  start_executor(options);
  auto slow = case_of_seconds();
  slow.mutable_loading()->set_speed_m_per_s(0.02);
  slow.mutable_loading()->clear_end_time_s();
  jobs::WorkerExit exit;
  exit.kind = Kind::stopped;
  int tasks = 0;
  std::vector<std::string> samples;
  std::int64_t last = -1;
  for (; exit.kind == Kind::stopped && tasks < 40; ++tasks) {
    const auto job = run(slow);
    exit = job->wait();
    samples = without_repeats(job->samples());
    EXPECT_GT(job->begun_steps().back(), last);
    last = job->begun_steps().back();
    if (exit.kind == Kind::stopped) {
      EXPECT_THAT(exit.detail, ::testing::HasSubstr("came to its time limit"));
    }
  }
  EXPECT_EQ(exit.kind, Kind::exited) << exit.detail;
  EXPECT_GT(tasks, 1);
  EXPECT_EQ(samples, local_samples(slow));
}

}  // namespace
}  // namespace cellcrush::testing
