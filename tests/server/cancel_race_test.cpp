// A cancel that meets a worker which leaves or is lost: each order of the two is forced and not waited for.
#include <gmock/gmock.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <functional>
#include <optional>
#include <thread>

#include "error.h"
#include "jobs/local_process.h"
#include "jobs/scheduler.h"
#include "jobs/worker_process.h"
#include "server/daemon_fixture.h"
#include "server/daemon_process.h"
#include "server/held_point.h"
#include "server/job_numbers.h"
#include "server/small_case.h"
#include "worker/worker_main.h"

namespace cellcrush::testing {
namespace {

// Workers as processes, and calls to a test between what they do and what the daemon makes of it. The calls are set
// before a job runs and come from its thread.
class HeldWorker final : public jobs::Executor {
 public:
  std::function<void(int run)> before_run = [](int) {};                 // the runs are counted from 0
  std::function<void(const v1::Sample&)> before_sample = [](auto&) {};  // it was read from the reports
  std::function<void(int run)> after_run = [](int) {};                  // the worker has ended

  bool has_worker(const store::JobFolder& folder) override { return workers_.has_worker(folder); }
  std::optional<jobs::WorkerExit> read_final_report(const store::JobFolder& folder,
                                                    const jobs::WorkerEvents& events) override {
    return workers_.read_final_report(folder, events);
  }
  void end_worker(const store::JobFolder& folder) override { workers_.end_worker(folder); }

  jobs::WorkerExit run(const store::JobFolder& folder, const worker::Order& order, const jobs::WorkerEvents& events,
                       const jobs::Interruptions& interruptions) override {
    const int number = runs_++;
    before_run(number);
    jobs::WorkerEvents held = events;
    held.reported = [&](worker::Report& report) {
      if (report.has_sample()) before_sample(report.sample());
      events.reported(report);
    };
    auto exit = workers_.run(folder, order, held, interruptions);
    after_run(number);
    return exit;
  }

 private:
  jobs::LocalProcess workers_{CELLCRUSHD_PROGRAM, std::chrono::seconds(20)};
  std::atomic<int> runs_ = 0;
};

// What the service puts together to run jobs, around a HeldWorker.
struct HeldJobs {
  explicit HeldJobs(const std::filesystem::path& path) : folder(path) { scheduler.start(1); }

  store::DataFolder folder;
  HeldPoint commit;
  std::atomic<bool> hold_next_commit = false;
  watch::Hub hub;
  metrics::Metrics metrics;
  store::Journal journal{folder.journal(), [](std::int64_t) {},
                         [this](double) {
                           if (hold_next_commit) commit.stand();
                         }};
  store::JournalReader reader{folder.journal()};
  HeldWorker worker;
  jobs::QueueHold hold{jobs::HoldTimes{}};
  jobs::JobRunner runner{{folder, journal, reader, hub, worker, metrics, hold, std::chrono::milliseconds(50), 0.0, 0}};
  jobs::Scheduler scheduler{{folder, journal, reader, metrics, runner, hold, worker}};
};

class CancelRaceTest : public DaemonFixture {
 protected:
  void SetUp() override { jobs_.emplace(data_folder()); }

  // The job's worker has reported this many samples when it stands at `at_sample_`.
  static constexpr int kBefore = 5;

  std::int64_t create() {
    v1::Job job;
    *job.mutable_case_() = endless_case();
    const auto number = jobs_->journal.create_job(job, "", "").job;
    jobs_->scheduler.enqueue({*jobs_->reader.queued_job(number, v1::Job::PENDING)});
    return number;
  }

  void stand_at_a_sample() {
    jobs_->worker.before_sample = [this, count = 0](const v1::Sample& sample) mutable {
      if (count++ == kBefore) at_sample_.stand();
      last_step_ = sample.step();
    };
  }

  void end_worker(std::int64_t job, int signal) {
    const auto worker = jobs::WorkerProcess::find(jobs_->folder.job_folder(job));
    ASSERT_TRUE(worker);
    worker->send(signal);
    ASSERT_TRUE(worker->ends_within(std::chrono::seconds(30)));
  }

  // Until commit.open nothing becomes durable.
  void hold_commits() {
    jobs_->hold_next_commit = true;
    committer_ = std::jthread([this] { jobs_->journal.note_service_clock(); });
    ASSERT_TRUE(jobs_->commit.wait());
  }

  // Cancels a job whose worker the signal ends, while samples of it are read and not durable. Meanwhile `look` is
  // called.
  std::int64_t cancel_before_samples_are_durable(
      int signal, const std::function<void()>& look = [] {}) {
    stand_at_a_sample();
    std::int64_t job = 0;
    jobs_->worker.before_run = [&](int run) {
      // This run makes the result of what was reported, beginning with the sample behind the last durable one.
      if (run != 1) return;
      const auto durable = jobs_->reader.samples(job).samples;
      EXPECT_TRUE(durable.empty() || durable.back().step() < last_step_);
      look();
      jobs_->commit.open();
    };
    job = create();
    EXPECT_TRUE(at_sample_.wait());
    end_worker(job, signal);
    jobs_->scheduler.cancel(job);
    hold_commits();
    at_sample_.open();
    EXPECT_TRUE(wait_until_cancelled(job));
    committer_.join();
    return job;
  }

  [[nodiscard]] bool wait_until_cancelled(std::int64_t job) {
    return wait_until([&] { return state_of(job) == v1::Job::CANCELLED; }, std::chrono::seconds(30));
  }

  [[nodiscard]] v1::Job::State state_of(std::int64_t job) { return jobs_->reader.find_job(job)->job.state(); }

  // Ends what the test holds and starts a daemon on the folder.
  Client daemon_on(const std::filesystem::path& folder) {
    jobs_.reset();
    auto options = default_options();
    options.data_folder = folder;
    start(options);
    return client();
  }

  // Of a job that was cancelled: every event once and in order, and a result that ends with the last sample.
  static void expect_sound(Client client) {
    const std::string job = "jobs/1";
    ASSERT_TRUE(client.wait_for_state(job, v1::Job::CANCELLED)) << v1::Job::State_Name(client.get(job).state());
    EXPECT_TRUE(watch_soundly(client, job).ok());
    const auto samples = client.history(job);
    ASSERT_GT(samples.size(), static_cast<std::size_t>(kBefore));
    for (std::size_t i = 1; i < samples.size(); ++i) ASSERT_GT(samples[i].step(), samples[i - 1].step());
    EXPECT_EQ(client.get(job).summary().step_count(), samples.back().step()) << client.get(job).cause_message();
  }

  std::optional<HeldJobs> jobs_;
  HeldPoint at_sample_;
  std::atomic<std::int64_t> last_step_ = -1;  // of the samples passed on
  std::jthread committer_;
};

TEST_F(CancelRaceTest, ACancelBetweenTheEndOfASuspendedWorkerAndItsStateEndsTheJob) {
  HeldPoint left;
  stand_at_a_sample();
  jobs_->worker.after_run = [&left](int) { left.stand(); };
  const auto job = create();
  ASSERT_TRUE(at_sample_.wait());
  std::jthread suspends([&] { EXPECT_THROW(jobs_->scheduler.suspend(job, [] { return false; }), ServiceError); });
  at_sample_.open();
  ASSERT_TRUE(left.wait());
  EXPECT_EQ(state_of(job), v1::Job::RUNNING);
  jobs_->scheduler.cancel(job);
  EXPECT_EQ(state_of(job), v1::Job::CANCELLING);
  left.open();
  EXPECT_TRUE(wait_until_cancelled(job));
  suspends.join();
  expect_sound(daemon_on(data_folder()));
}

TEST_F(CancelRaceTest, SamplesThatAreNotDurableWhenACancelledWorkerIsKilledComeOnce) {
  cancel_before_samples_are_durable(SIGKILL);
  expect_sound(daemon_on(data_folder()));
}

TEST_F(CancelRaceTest, SamplesThatAreNotDurableWhenACancelledWorkerLeavesComeOnce) {
  cancel_before_samples_are_durable(worker::kSuspendSignal);
  expect_sound(daemon_on(data_folder()));
}

TEST_F(CancelRaceTest, SamplesThatAreNotDurableWhenWorkerAndDaemonAreKilledComeOnce) {
  const auto left_behind = folder_.path() / "left-behind";
  cancel_before_samples_are_durable(
      SIGKILL, [&] { std::filesystem::copy(data_folder(), left_behind, std::filesystem::copy_options::recursive); });
  expect_sound(daemon_on(left_behind));
}

}  // namespace
}  // namespace cellcrush::testing
