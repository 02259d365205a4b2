// What the daemon lacks for a while holds the queue and ends no job.
#include <gmock/gmock.h>

#include <csignal>
#include <filesystem>
#include <set>

#include "log_format.h"
#include "server/daemon_fixture.h"
#include "server/daemon_process.h"
#include "server/job_numbers.h"
#include "server/log_capture.h"
#include "server/small_case.h"

namespace cellcrush::testing {
namespace {

using ::testing::HasSubstr;

class HeldQueueTest : public DaemonFixture {
 protected:
  void SetUp() override {}

  [[nodiscard]] DaemonOptions impatient() const {
    auto options = default_options();
    options.hold_times = {std::chrono::milliseconds(20), std::chrono::milliseconds(200)};
    return options;
  }

  [[nodiscard]] std::filesystem::path program() const { return folder_.path() / "program"; }

  void install_program() const { std::filesystem::create_symlink(CELLCRUSHD_PROGRAM, program()); }

  static bool wait_until_held(const Client& client) {
    return wait_until([&] { return !client.queue().holds().empty(); });
  }
};

TEST_F(HeldQueueTest, AWorkerProgramThatIsMissingHoldsItUntilItIsThere) {
  const LogCapture log(make_text_formatter());
  auto options = impatient();
  options.worker_program = program();
  start(options);
  auto client = this->client();
  EXPECT_TRUE(is_serving(client, "cellcrush.queue"));
  std::vector<std::string> jobs;
  for (int i = 0; i < 20; ++i) jobs.push_back(client.create(tiny_case()));
  ASSERT_TRUE(wait_until_held(client));
  std::set<std::string> tries;
  ASSERT_TRUE(wait_until([&] {
    tries.insert(client.queue().holds(0).next_try_time().SerializeAsString());
    return tries.size() == 5;
  }));

  const auto queue = client.queue();
  ASSERT_EQ(queue.holds_size(), 1);
  EXPECT_EQ(queue.holds(0).cause(), "worker");
  EXPECT_THAT(queue.holds(0).reason(), HasSubstr("No such file"));
  EXPECT_THAT(queue.holds(0).remedy(), HasSubstr("Reinstall cellcrushd"));
  EXPECT_TRUE(queue.holds(0).has_next_try_time());
  EXPECT_GT(queue.holds(0).since().seconds(), 1'600'000'000);
  EXPECT_THAT(queue.entries(0).reason(), HasSubstr("The queue is held: No worker process could be started"));
  EXPECT_FALSE(is_serving(client, "cellcrush.queue"));
  EXPECT_TRUE(is_serving(client, "cellcrush.v1.Jobs"));
  for (const auto& job : jobs) {
    EXPECT_EQ(client.get(job).state(), v1::Job::PENDING);
    EXPECT_EQ(client.get(job).attempt(), 0) << "It waits as it was.";
  }

  install_program();
  for (const auto& job : jobs)
    EXPECT_TRUE(client.wait_for_state(job, v1::Job::SUCCEEDED)) << client.get(job).cause_message();
  EXPECT_TRUE(client.queue().holds().empty());
  EXPECT_TRUE(is_serving(client, "cellcrush.queue"));
  EXPECT_EQ(log.count_lines("The queue is held"), 1);
  EXPECT_EQ(log.count_lines("The queue is released"), 1);
}

TEST_F(HeldQueueTest, AJobThatIsCancelledOrSuspendedWhileItIsHeldIs) {
  auto options = impatient();
  options.worker_program = program();
  start(options);
  auto client = this->client();
  const std::string cancelled = client.create(tiny_case());
  const std::string suspended = client.create(tiny_case());
  ASSERT_TRUE(wait_until_held(client));
  EXPECT_TRUE(client.cancel(cancelled).ok());
  EXPECT_TRUE(client.suspend(suspended).ok());
  EXPECT_EQ(client.get(cancelled).state(), v1::Job::CANCELLED);
  EXPECT_EQ(client.get(suspended).state(), v1::Job::SUSPENDED);
  install_program();
  EXPECT_TRUE(client.resume(suspended).ok());
  EXPECT_TRUE(client.wait_for_state(suspended, v1::Job::SUCCEEDED));
}

TEST_F(HeldQueueTest, AWorkerThatIsStoppedIsSuspendedAtItsLastCheckpointInBoundedTime) {
  auto options = impatient();
  options.checkpoint_interval = std::chrono::milliseconds(50);
  options.stall_limit = std::chrono::milliseconds(2000);
  start(options);
  auto client = this->client();
  const std::string job = create_with_samples(client, endless_case(), 20);
  const pid_t worker = client.worker_of(job);
  ASSERT_EQ(kill(worker, SIGSTOP), 0);
  EXPECT_TRUE(client.suspend(job).ok());
  EXPECT_EQ(client.get(job).state(), v1::Job::SUSPENDED);
  EXPECT_FALSE(is_alive(worker));
  EXPECT_TRUE(client.resume(job).ok());
  ASSERT_TRUE(client.wait_for_state(job, v1::Job::RUNNING));
  EXPECT_TRUE(client.cancel(job).ok());
}

}  // namespace
}  // namespace cellcrush::testing
