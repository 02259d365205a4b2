#include <gmock/gmock.h>
#include <signal.h>

#include "server/daemon_fixture.h"
#include "server/daemon_process.h"
#include "server/small_case.h"

namespace cellcrush::testing {
namespace {

using ::testing::HasSubstr;

class WorkerFailureTest : public DaemonFixture {
 protected:
  pid_t worker_of(const std::string& job) {
    auto client = this->client();
    EXPECT_TRUE(client.wait_for_state(job, v1::RUNNING));
    return static_cast<pid_t>(client.get(job).worker_pid());
  }
};

TEST_F(WorkerFailureTest, AKilledWorkerFailsItsJobAndTheDaemonGoesOn) {
  auto client = this->client();
  for (const auto& [number, name] : {std::pair{SIGKILL, "SIGKILL (9)"}, std::pair{SIGSEGV, "SIGSEGV (11)"}}) {
    const std::string job = client.create(endless_case());
    const pid_t worker = worker_of(job);
    ASSERT_GT(worker, 0);
    ASSERT_EQ(kill(worker, number), 0);
    const auto watched = client.watch(job);
    EXPECT_TRUE(watched.status.ok());
    const auto failed = client.get(job);
    EXPECT_EQ(failed.state(), v1::FAILED);
    EXPECT_EQ(failed.cause(), v1::WORKER_CRASHED);
    EXPECT_THAT(failed.cause_message(), HasSubstr(name));
    EXPECT_EQ(failed.worker_pid(), 0);
    EXPECT_FALSE(is_alive(worker));
  }
  const std::string next = client.create(small_case());
  EXPECT_TRUE(client.watch(next).status.ok());
  EXPECT_EQ(client.get(next).state(), v1::SUCCEEDED);
}

TEST_F(WorkerFailureTest, AWorkerThatCannotBeStartedFailsItsJob) {
  auto options = default_options();
  options.worker_program = folder_.path() / "absent";
  start(options);
  auto client = this->client();
  const std::string job = client.create(small_case());
  EXPECT_TRUE(client.watch(job).status.ok());
  EXPECT_EQ(client.get(job).cause(), v1::WORKER_CRASHED);
  EXPECT_THAT(client.get(job).cause_message(), HasSubstr("No such file"));
}

TEST_F(WorkerFailureTest, AProgramThatIsNoWorkerFailsItsJobWithItsExitCode) {
  auto options = default_options();
  options.worker_program = "/bin/false";
  start(options);
  auto client = this->client();
  const std::string job = client.create(small_case());
  EXPECT_TRUE(client.watch(job).status.ok());
  EXPECT_EQ(client.get(job).cause(), v1::WORKER_CRASHED);
  EXPECT_THAT(client.get(job).cause_message(), HasSubstr("exit code 1"));
}

TEST_F(WorkerFailureTest, AtTheDaemonsEndTheWorkerGoesAndItsJobIsLost) {
  std::string job;
  std::string waiting;
  pid_t worker = 0;
  {
    auto options = default_options();
    options.workers = 1;
    start(options);
    auto client = this->client();
    job = client.create(endless_case());
    worker = worker_of(job);
    waiting = client.create(small_case());
  }
  daemon_->stop();
  EXPECT_FALSE(is_alive(worker));
  start();
  auto client = this->client();
  EXPECT_EQ(client.get(job).state(), v1::FAILED);
  EXPECT_EQ(client.get(job).cause(), v1::WORKER_LOST);
  EXPECT_TRUE(client.watch(waiting).status.ok());
  EXPECT_EQ(client.get(waiting).state(), v1::SUCCEEDED);
}

}  // namespace
}  // namespace cellcrush::testing
