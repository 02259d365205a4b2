#include <gmock/gmock.h>

#include "server/daemon_fixture.h"
#include "server/small_case.h"

namespace cellcrush::testing {
namespace {

using ::testing::HasSubstr;

using WorkerFailureTest = DaemonFixture;

TEST_F(WorkerFailureTest, AProgramThatIsNoWorkerFailsItsJobWithItsExitCode) {
  auto options = default_options();
  options.worker_program = "/bin/false";
  start(options);
  auto client = this->client();
  const std::string job = client.create(small_case());
  EXPECT_TRUE(client.watch(job).status.ok());
  EXPECT_EQ(client.get(job).cause(), v1::Job::WORKER_CRASHED);
  EXPECT_THAT(client.get(job).cause_message(), HasSubstr("exited with code 1"));
}

}  // namespace
}  // namespace cellcrush::testing
