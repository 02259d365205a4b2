// What is deleted by itself and on request, and what no clock can delete.
#include <gmock/gmock.h>

#include <atomic>
#include <filesystem>
#include <thread>

#include "log_format.h"
#include "server/daemon_fixture.h"
#include "server/daemon_process.h"
#include "server/log_capture.h"
#include "server/small_case.h"
#include "server/sweep_requests.h"
#include "store/journal.h"
#include "store/journal_reader.h"

namespace cellcrush::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr std::chrono::hours kMonth{31 * 24};

class RetentionTest : public DaemonFixture {
 protected:
  void SetUp() override {}

  [[nodiscard]] DaemonOptions quick_options() const {
    auto options = default_options();
    options.housekeeping_interval = std::chrono::milliseconds(20);
    return options;
  }

  std::vector<std::string> names() {
    v1::ListJobsRequest request;
    request.set_order_by("name");
    std::vector<std::string> out;
    for (const auto& job : client().list(request)) out.push_back(job.name());
    return out;
  }

  // Waits until so many jobs are left.
  std::vector<std::string> names_once(std::size_t count) {
    wait_until([&] { return names().size() == count; });
    return names();
  }

  v1::Sweep make_sweep(Client& client) { return create(client, sweep_of(tiny_case(), kSpeed, {50.0, 100.0})); }

  static grpc::Status delete_sweep(Client& client, const std::string& name) {
    return try_call(*client.sweeps, &v1::Sweeps::Stub::DeleteSweep, named<v1::DeleteSweepRequest>(name));
  }

  static grpc::StatusCode look_up(Client& client, const std::string& sweep) {
    return try_call(*client.sweeps, &v1::Sweeps::Stub::GetSweep, named<v1::GetSweepRequest>(sweep)).error_code();
  }

  [[nodiscard]] std::size_t folder_count() const {
    std::size_t out = 0;
    for (const auto& entry : std::filesystem::directory_iterator(data_folder() / "jobs")) out += entry.is_directory();
    return out;
  }

  std::atomic<std::chrono::nanoseconds> wall_ahead_{};
  std::atomic<std::chrono::nanoseconds> uptime_ahead_{};
};

TEST_F(RetentionTest, AWallClockThatJumpsDeletesNothingAndTheServiceClockDoes) {
  const LogCapture log(make_text_formatter());
  auto options = quick_options();
  options.keep.age = std::chrono::hours(30 * 24);
  options.clocks.wall = [this] { return Clocks::read(CLOCK_REALTIME) + wall_ahead_.load(); };
  options.clocks.uptime = [this] { return Clocks::read(CLOCK_BOOTTIME) + uptime_ahead_.load(); };
  start(options);
  auto client = this->client();
  const std::string job = finished_job(tiny_case());
  wall_ahead_ = kMonth;
  EXPECT_TRUE(wait_until([&] { return log.count_lines("The wall clock was set forward by 26784") == 1; }))
      << log.text();
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  EXPECT_THAT(names(), ElementsAre(job));
  uptime_ahead_ = kMonth;
  EXPECT_THAT(names_once(0), IsEmpty());
}

// Jobs without a sweep that have ended: cancelled before they ran.
class ManyEndedTest : public RetentionTest {
 protected:
  static constexpr std::size_t kJobs = 1600;

  void SetUp() override {
    const store::DataFolder folder(data_folder());
    store::Journal journal(folder.journal(), [](std::int64_t) {});
    v1::Job job;
    *job.mutable_case_() = tiny_case();
    std::vector<std::int64_t> jobs;
    for (std::size_t i = 0; i < kJobs; ++i) jobs.push_back(journal.create_job(job, "", "").job);
    journal.cancel_waiting(jobs);
  }

  [[nodiscard]] DaemonOptions slow_options() const {
    auto options = default_options();
    options.housekeeping_interval = std::chrono::hours(1);
    return options;
  }
};

TEST_F(ManyEndedTest, AllThatExceedsTheCountIsDeletedInOneRoundOfHousekeeping) {
  auto options = slow_options();
  options.keep.count = 10;
  start(options);
  EXPECT_EQ(names_once(10).size(), 10U);
}

TEST_F(ManyEndedTest, AllAreMeasuredInOneRoundOfHousekeeping) {
  start(slow_options());
  store::JournalReader reader(data_folder() / "journal.sqlite");
  EXPECT_TRUE(wait_until([&reader] { return reader.jobs_to_measure(1).empty(); }));
}

TEST_F(RetentionTest, TimeWithoutADaemonMakesNothingOld) {
  auto options = quick_options();
  options.keep.age = std::chrono::hours(30 * 24);
  options.clocks.uptime = [this] { return Clocks::read(CLOCK_BOOTTIME) + uptime_ahead_.load(); };
  start(options);
  std::string job;
  {
    auto client = this->client();
    job = finished_job(tiny_case());
  }
  daemon_.reset();
  uptime_ahead_ = kMonth;
  start(options);
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  EXPECT_THAT(names(), ElementsAre(job));
}

TEST_F(RetentionTest, OfTooManyThoseThatEndedFirstGoAndASweepGoesWhole) {
  start(quick_options());
  std::string alone;
  {
    auto client = this->client();
    const auto sweep = make_sweep(client);
    ASSERT_TRUE(wait_for_count(client, sweep.name(), v1::Job::SUCCEEDED, 2));
    // The clock that tells which ended first has seconds.
    std::this_thread::sleep_for(std::chrono::milliseconds(1100));
    alone = finished_job(tiny_case());
  }
  auto options = quick_options();
  options.keep.count = 2;
  start(options);
  EXPECT_THAT(names_once(1), ElementsAre(alone)) << "Without one of its jobs the sweep would be another.";
  auto client = this->client();
  EXPECT_EQ(look_up(client, "sweeps/1"), grpc::StatusCode::NOT_FOUND);
  EXPECT_TRUE(wait_until([this] { return folder_count() == 1; })) << "Folders go after the jobs of the list.";
}

TEST_F(RetentionTest, ASweepThatHasNotEndedIsKept) {
  auto options = quick_options();
  options.workers = 1;
  options.keep.count = 1;
  start(options);
  auto client = this->client();
  auto request = sweep_of(tiny_case(), kSpeed, {50.0, 100.0});
  request.mutable_sweep()->set_max_parallel(1);
  *request.mutable_sweep()->mutable_case_() = endless_case();
  const auto sweep = create(client, request);
  ASSERT_TRUE(wait_for_count(client, sweep.name(), v1::Job::RUNNING, 1));
  for (const auto& job : sweep.jobs()) {
    if (client.get(job).state() != v1::Job::PENDING) continue;
    ASSERT_TRUE(client.cancel(job).ok());
  }
  for (int i = 0; i < 2; ++i) {
    const std::string other = client.create(tiny_case());
    ASSERT_TRUE(client.cancel(other).ok());
  }
  EXPECT_EQ(names_once(2).size(), 2U) << "The two that ended alone went.";
  EXPECT_EQ(get_sweep(client, sweep.name()).jobs_size(), 2);
}

TEST_F(RetentionTest, ResultsBeyondTheSizeGo) {
  auto options = quick_options();
  options.keep.bytes = 1;
  start(options);
  auto client = this->client();
  client.create(tiny_case());
  client.create(tiny_case());
  EXPECT_THAT(names_once(0), IsEmpty());
  options.keep.bytes = 1'000'000'000;
  start(options);
  auto next = this->client();
  const std::string kept = finished_job(tiny_case());
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  EXPECT_THAT(names(), ElementsAre(kept));
}

TEST_F(RetentionTest, ASweepIsDeletedWithItsJobsOnceTheyHaveEnded) {
  auto options = quick_options();
  start(options);
  auto client = this->client();
  const auto sweep = create(client, sweep_of(endless_case(), kSpeed, {50.0, 100.0, 150.0}));
  ASSERT_TRUE(wait_for_count(client, sweep.name(), v1::Job::RUNNING, 2));
  const std::string alone = client.create(tiny_case());
  const auto refused = delete_sweep(client, sweep.name());
  EXPECT_THAT(refused, Fails(grpc::StatusCode::FAILED_PRECONDITION, sweep.jobs(0) + " is RUNNING"));
  cancel_sweep(client, sweep.name());
  ASSERT_TRUE(wait_for_count(client, sweep.name(), v1::Job::CANCELLED, 3));
  ASSERT_TRUE(client.wait_for_state(alone, v1::Job::SUCCEEDED));
  const auto deleted = delete_sweep(client, sweep.name());
  EXPECT_TRUE(deleted.ok()) << deleted.error_message();
  EXPECT_EQ(look_up(client, sweep.name()), grpc::StatusCode::NOT_FOUND);
  EXPECT_THAT(names(), ElementsAre(alone));
  EXPECT_TRUE(wait_until([this] { return folder_count() == 1; })) << "Folders go after the jobs of the list.";
  EXPECT_EQ(delete_sweep(client, sweep.name()).error_code(), grpc::StatusCode::NOT_FOUND);
}

// Half of a job's folder has another name than a job.
TEST_F(RetentionTest, ADeletionThatWasCutShortIsFinishedByTheNextDaemon) {
  start(quick_options());
  const std::string job = finished_job(tiny_case());
  daemon_.reset();
  store::Journal(data_folder() / "journal.sqlite", [](std::int64_t) {}).delete_job(1);
  const auto folder = data_folder() / job;
  std::filesystem::rename(folder, folder.string() + ".deleted");
  std::filesystem::create_directory(folder);
  start(quick_options());
  EXPECT_EQ(folder_count(), 0U);
  EXPECT_FALSE(std::filesystem::exists(data_folder() / "set-aside"));
}

}  // namespace
}  // namespace cellcrush::testing
