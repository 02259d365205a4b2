// What goes wrong outside the case: a worker or a daemon that dies or is asked to go.
#include <gmock/gmock.h>
#include <unistd.h>

#include <csignal>
#include <nlohmann/json.hpp>

#include "e2e/daemon_test.h"

namespace cellcrush::e2e {
namespace {

using cellcrush::testing::wait_until;
using nlohmann::json;
using ::testing::HasSubstr;

class Failure : public DaemonTest {
 protected:
  // Submits a case that takes far longer than the test and returns its name once a worker runs it.
  std::string start_long_job() {
    const Outcome submitted = cellcrush({"submit", "preset:type-i", "--set", "loading.speed_m_per_s=1", "--json"});
    EXPECT_EQ(submitted.exit_code, 0) << submitted.all();
    const json object = json::parse(submitted.output, nullptr, false);
    if (!object.is_object() || !object.contains("name")) {
      ADD_FAILURE() << "No job in: " << submitted.all();
      return "";
    }
    std::string job = object["name"].get<std::string>();
    EXPECT_TRUE(wait_until([&] { return (worker_ = worker_of(job)) > 0; }, kShortLimit)) << job << " was not started.";
    return job;
  }

  [[nodiscard]] json job_object(const std::string& job) const {
    return json::parse(cellcrush({"show", job, "--json"}).output, nullptr, false);
  }

  [[nodiscard]] pid_t worker_of(const std::string& job) const {
    const json object = job_object(job);
    if (!object.is_object() || object["state"] != "RUNNING" || !object.contains("worker_pid")) return 0;
    return static_cast<pid_t>(std::stol(object["worker_pid"].get<std::string>()));
  }

  // Whether the process ends within 10 s; a zombie counts as ended.
  static bool ends(pid_t process) {
    return wait_until([process] { return kill(process, 0) != 0; }, std::chrono::seconds(10));
  }

  pid_t worker_ = 0;
};

TEST_F(Failure, ADrainThatWaitsReturnsOnceTheDaemonHasGone) {
  start_long_job();
  const Outcome drained = cellcrush({"drain", "--wait"});
  EXPECT_EQ(drained.exit_code, 0) << drained.all();
  EXPECT_THAT(drained.output, HasSubstr("the server has exited"));
  EXPECT_TRUE(ends(worker_));
  EXPECT_EQ(daemon().wait(std::chrono::seconds(5)).exit_code, 0);
  start_daemon();
  EXPECT_EQ(cellcrush({"list"}).exit_code, 0) << "The next one has the folder at once.";
}

TEST_F(Failure, AKilledWorkerIsReplacedAndItsJobGoesOn) {
  const std::string job = start_long_job();
  ASSERT_GT(worker_, 0);
  ASSERT_EQ(kill(worker_, SIGKILL), 0);
  EXPECT_TRUE(wait_until([&] { return worker_of(job) > 0 && worker_of(job) != worker_; }, kShortLimit));
  const Outcome shown = cellcrush({"show", job});
  EXPECT_THAT(shown.output, HasSubstr("RUNNING"));
  EXPECT_THAT(shown.output, HasSubstr("2; 1 was lost or left the job")) << shown.all();
  EXPECT_EQ(cellcrush({"submit", write_file("small.txtpb", small_case()), "--watch"}, kCrushLimit).exit_code, 0)
      << "The daemon takes the next job.";
}

TEST_F(Failure, AKilledDaemonLosesNoJobAndNoWorker) {
  const std::string job = start_long_job();
  ASSERT_GT(worker_, 0);
  Process watch(command({"watch", job}));
  ASSERT_TRUE(watch.wait_for_output("%", kShortLimit)) << watch.output() << watch.errors();
  daemon().send(SIGKILL);
  const Outcome watched = watch.wait(kShortLimit);
  EXPECT_EQ(watched.exit_code, 4) << watched.all();
  EXPECT_EQ(daemon().wait(kShortLimit).exit_code, 128 + SIGKILL);
  EXPECT_EQ(kill(worker_, 0), 0) << "The worker goes with its daemon.";
  start_daemon();
  EXPECT_EQ(worker_of(job), worker_);
  EXPECT_EQ(cellcrush({"cancel", job}).exit_code, 0);
  EXPECT_TRUE(ends(worker_)) << "The next daemon has no hold of it.";
}

TEST_F(Failure, AJobIsSuspendedAndResumed) {
  const std::string job = start_long_job();
  const Outcome suspended = cellcrush({"suspend", job});
  EXPECT_EQ(suspended.exit_code, 0) << suspended.all();
  EXPECT_THAT(suspended.output, HasSubstr("SUSPENDED"));
  EXPECT_TRUE(ends(worker_));
  const Outcome resumed = cellcrush({"resume", job});
  EXPECT_EQ(resumed.exit_code, 0) << resumed.all();
  EXPECT_TRUE(wait_until([&] { return worker_of(job) > 0; }, kShortLimit));
}

}  // namespace
}  // namespace cellcrush::e2e
