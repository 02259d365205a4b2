#include <gmock/gmock.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <thread>

#include "programs/text_proto.h"
#include "server/daemon_fixture.h"
#include "server/daemon_process.h"
#include "server/job_numbers.h"
#include "server/small_case.h"
#include "server/sweep_requests.h"
#include "store/data_folder.h"
#include "store/journal.h"
#include "store/result_reader.h"

namespace cellcrush::testing {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;
using Clock = std::chrono::steady_clock;

class JobLifeTest : public DaemonFixture {
 protected:
  // The job's result.h5, downloaded.
  std::filesystem::path fetched_result(Client& client, const std::string& job) {
    grpc::Status status;
    const std::string bytes = client.download(job, 0, status);
    EXPECT_TRUE(status.ok()) << status.error_message();
    auto copy = folder_.path() / "copy.h5";
    std::ofstream(copy, std::ios::binary) << bytes;
    return copy;
  }

  // A job that runs and has given samples.
  std::string running_job() {
    auto client = this->client();
    std::string job = create_with_samples(client, endless_case(), 5);
    EXPECT_GE(client.history(job).size(), 5U);
    EXPECT_EQ(client.get(job).state(), v1::Job::RUNNING);
    return job;
  }

  [[nodiscard]] std::filesystem::path folder_of(const std::string& job) const { return data_folder() / job; }
};

std::ptrdiff_t threads_of(std::int64_t process) {
  const std::filesystem::directory_iterator tasks("/proc/" + std::to_string(process) + "/task");
  return std::distance(begin(tasks), end(tasks));
}

TEST_F(JobLifeTest, AJobThatAsksForThreadsTakesTheCoresThatNobodyElseUses) {
  auto client = this->client();
  auto threaded = endless_case();
  threaded.mutable_numerics()->set_threads(8);
  const std::string both = client.create(threaded, v1::Job::RUNNING);
  const std::string waits = client.create(threaded);
  wait_for_samples(client, both, 1);
  const auto with_both = threads_of(client.get(both).worker_pid());
  EXPECT_EQ(client.get(waits).state(), v1::Job::PENDING);
  ASSERT_TRUE(client.cancel(both).ok());

  // With another job at once, each has a core of the two.
  ASSERT_TRUE(client.wait_for_state(waits, v1::Job::RUNNING));
  ASSERT_TRUE(client.cancel(waits).ok());
  const v1::Sweep sweep = create(client, sweep_of(threaded, kSpeed, {1.0, 2.0}));
  for (const auto& job : sweep.jobs()) {
    ASSERT_TRUE(client.wait_for_state(job, v1::Job::RUNNING));
    wait_for_samples(client, job, 1);
    EXPECT_EQ(threads_of(client.get(job).worker_pid()), with_both - 1) << job;
  }
}

TEST_F(JobLifeTest, ARunningJobStopsAndWhatItHasComputedIsKept) {
  auto client = this->client();
  const std::string job = running_job();
  const pid_t worker = client.worker_of(job);
  const auto start = Clock::now();
  ASSERT_TRUE(client.cancel(job).ok());
  const auto watched = client.watch(job);
  const auto taken = std::chrono::duration<double>(Clock::now() - start).count();
  std::cout << "cancelled within " << taken << " s\n";
  EXPECT_LT(taken, 2.0) << "A second, and as much again for a machine that is busy.";
  EXPECT_TRUE(watched.status.ok());
  EXPECT_EQ(watched.events.back().state().state(), v1::Job::CANCELLED);
  EXPECT_FALSE(is_alive(worker));

  const auto cancelled = client.get(job);
  EXPECT_EQ(cancelled.state(), v1::Job::CANCELLED);
  EXPECT_EQ(cancelled.cause(), v1::Job::JOB_CAUSE_UNSPECIFIED);
  EXPECT_EQ(cancelled.worker_pid(), 0);
  ASSERT_TRUE(cancelled.has_summary());
  EXPECT_FALSE(cancelled.summary().has_plateau_stress_impact_mpa());
  const auto history = client.history(job);
  EXPECT_EQ(history.back().step(), cancelled.summary().step_count());

  const store::ResultReader result(fetched_result(client, job));
  const auto stored = result.history();
  ASSERT_EQ(stored.size(), history.size());
  EXPECT_EQ(stored.back().strain(), history.back().strain());
  EXPECT_GE(result.frame_times().size(), 2U);
  EXPECT_EQ(result.frame_times().back(), stored.back().time_s());
  EXPECT_THAT(result.text_attribute("case"), HasSubstr("A few cells"));
  EXPECT_FALSE(std::filesystem::exists(folder_of(job) / "result.h5.partial"));
}

// Thin triangles at a speed and with contacts that the step is far too long for.
TEST_F(JobLifeTest, ARunThatIsUntrueFailsByNameAndKeepsWhatItComputedBefore) {
  auto client = this->client();
  const v1::Case bad = with_text(small_case(), R"(
    lattice { triangle { columns: 12 rows: 6 side_mm: 4 wall_thickness_mm: 0.1185 } } elements_per_wall: 2
    loading { speed_m_per_s: 400 } contact { stiffness_factor: 1 } numerics { time_step_s: 2.26e-7 }
    output { sample_count: 1000 frame_count: 1 })");
  const std::string job = client.create(bad);
  EXPECT_TRUE(client.watch(job).status.ok());
  const auto failed = client.get(job);
  EXPECT_EQ(failed.state(), v1::Job::FAILED);
  EXPECT_THAT(failed.cause(), AnyOf(v1::Job::LARGE_ROTATION, v1::Job::CONTACT_ENERGY, v1::Job::ENERGY_BALANCE));
  EXPECT_THAT(failed.cause_message(), HasSubstr("step "));
  EXPECT_THAT(failed.cause_message(), HasSubstr("mm before loading"));
  EXPECT_THAT(failed.remedy(), HasSubstr("numerics.time_step_s"));
  ASSERT_TRUE(failed.has_summary());

  const store::ResultReader result(fetched_result(client, job));
  EXPECT_EQ(result.text_attribute("failure"), failed.cause_message());
  const auto history = result.history();
  EXPECT_EQ(history.size(), client.history(job).size());
  ASSERT_GE(history.size(), 5U);
  ASSERT_EQ(result.frame_times().size(), 2U) << "The undeformed lattice and the last good frame.";
  EXPECT_LE(result.frame_times().back(), history.back().time_s());
  EXPECT_GE(result.frame_times().back(), 0.8 * history.back().time_s());
}

TEST_F(JobLifeTest, AWaitingJobIsCancelledAtOnceAndNeverRuns) {
  start(with_workers(1));
  auto client = this->client();
  const std::string first = running_job();
  const std::string waiting = client.create(small_case());
  const std::string next = client.create(small_case());
  ASSERT_TRUE(client.cancel(waiting).ok());
  EXPECT_EQ(client.get(waiting).state(), v1::Job::CANCELLED);
  ASSERT_TRUE(client.cancel(first).ok());
  EXPECT_TRUE(client.wait_for_state(next, v1::Job::SUCCEEDED));
  EXPECT_EQ(client.watch(waiting).events.size(), 3U) << "Its snapshot, PENDING and CANCELLED.";
  EXPECT_FALSE(client.get(waiting).has_start_time());
  grpc::Status status;
  client.download(waiting, 0, status);
  EXPECT_EQ(status.error_code(), grpc::StatusCode::FAILED_PRECONDITION);
}

TEST_F(JobLifeTest, CancellingAgainChangesNothingAndAnEndedJobCannotBeCancelled) {
  auto client = this->client();
  const std::string job = running_job();
  EXPECT_THAT(client.remove(job), Fails(grpc::StatusCode::FAILED_PRECONDITION, "Cancel it, then delete it"));
  ASSERT_TRUE(client.cancel(job).ok());
  ASSERT_TRUE(client.cancel(job).ok());
  ASSERT_TRUE(client.wait_for_state(job, v1::Job::CANCELLED));
  ASSERT_TRUE(client.cancel(job).ok());
  EXPECT_EQ(client.get(job).state(), v1::Job::CANCELLED);
  const std::string done = client.create(small_case(), v1::Job::SUCCEEDED);
  const auto refused = client.cancel(done);
  EXPECT_THAT(refused, Fails(grpc::StatusCode::FAILED_PRECONDITION, "SUCCEEDED"));
}

TEST_F(JobLifeTest, ManyCancelledAtAnyMomentAllEndInOrder) {
  auto client = this->client();
  std::vector<std::string> jobs;
  for (int i = 0; i < 20; ++i) {
    jobs.push_back(client.create(i % 2 == 0 ? endless_case() : small_case()));
    if (i % 4 == 1) wait_for_samples(client, jobs.back(), 1);
    if (i % 4 == 2) client.wait_for_state(jobs.back(), v1::Job::RUNNING);
    if (i % 8 == 4) wait_for_samples(client, jobs.back(), 5);
    const auto status = client.cancel(jobs.back());
    EXPECT_TRUE(status.ok() || status.error_code() == grpc::StatusCode::FAILED_PRECONDITION) << status.error_message();
  }
  for (const auto& job : jobs) {
    const auto watched = client.watch(job);
    EXPECT_TRUE(watched.status.ok());
    const auto state = watched.events.back().state().state();
    EXPECT_TRUE(state == v1::Job::CANCELLED || state == v1::Job::SUCCEEDED) << job << v1::Job::State_Name(state);
    EXPECT_EQ(client.get(job).has_summary(), std::filesystem::exists(folder_of(job) / "result.h5")) << job;
  }
}

TEST_F(JobLifeTest, ADeletedJobIsGoneWithAllItLeft) {
  auto client = this->client();
  auto request = job_of(small_case());
  request.set_request_id("id");
  const std::string job = client.create(request).name();
  expect_success(client, job);
  ASSERT_TRUE(std::filesystem::exists(folder_of(job) / "result.h5"));
  ASSERT_TRUE(client.remove(job).ok());
  EXPECT_FALSE(std::filesystem::exists(folder_of(job)));
  EXPECT_EQ(client.remove(job).error_code(), grpc::StatusCode::NOT_FOUND);
  EXPECT_EQ(client.watch(job).status.error_code(), grpc::StatusCode::NOT_FOUND);
  EXPECT_TRUE(client.list().empty());
  EXPECT_EQ(client.create(request).name(), "jobs/2") << "Its request_id is free, its number is not used again.";
}

TEST_F(JobLifeTest, ADeletionMayMeetTheTidyingUpOfARunThatHasJustEnded) {
  const store::DataFolder data(folder_.path() / "deleted");
  for (int round = 0; round < 200; ++round) {
    data.make_job_folder(1);
    const store::JobFolder job = data.job_folder(1);
    for (const auto& file : {job.order(), job.claim(), job.checkpoint(), job.previous_checkpoint(), job.reports()})
      std::ofstream(file) << "left";
    std::atomic<int> ready = 0;
    const auto meet = [&ready] {
      ++ready;
      while (ready < 2) std::this_thread::yield();
    };
    std::thread tidying_up([&] {
      meet();
      EXPECT_NO_THROW(data.clean_job_folder(1));
    });
    meet();
    EXPECT_NO_THROW(data.remove_job_folder(1));
    tidying_up.join();
    ASSERT_FALSE(std::filesystem::exists(job.root())) << round;
  }
}

TEST_F(JobLifeTest, AFolderThatADeletionLeftBehindGoesAtTheNextStart) {
  auto client = this->client();
  const std::string job = client.create(small_case(), v1::Job::SUCCEEDED);
  daemon_.reset();
  {
    store::Journal journal(data_folder() / "journal.sqlite", [](std::int64_t) {});
    journal.delete_job(1);
  }
  ASSERT_TRUE(std::filesystem::exists(folder_of(job)));
  start();
  EXPECT_FALSE(std::filesystem::exists(folder_of(job)));
}

}  // namespace
}  // namespace cellcrush::testing
