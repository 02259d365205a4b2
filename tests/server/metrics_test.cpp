#include <gmock/gmock.h>
#include <grpcpp/generic/generic_stub.h>
#include <sys/resource.h>

#include <chrono>
#include <ctime>
#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "access/unix_user.h"
#include "cellcrush/simd.h"
#include "error.h"
#include "revision.h"
#include "server/daemon_fixture.h"
#include "server/daemon_process.h"
#include "server/http/http_socket.h"
#include "server/small_case.h"
#include "server/small_cluster.h"
#include "server/sweep_requests.h"
#include "store/journal.h"
#include "store/sqlite.h"

namespace cellcrush::testing {
namespace {

using ::testing::HasSubstr;

class MetricsTest : public DaemonFixture {
 protected:
  void SetUp() override { start(measured(2)); }

  // The cluster outlives the daemon.
  void TearDown() override { daemon_.reset(); }

  [[nodiscard]] DaemonOptions measured(int workers) const {
    auto options = with_workers(workers);
    options.metrics = "127.0.0.1:0";
    options.limits.free_disk_bytes = 1000;
    return options;
  }

  [[nodiscard]] int port() const {
    const std::string& url = daemon_->metrics_url();
    return std::stoi(url.substr(url.rfind(':') + 1));
  }

  /// What a GET of the daemon's metrics answers, head and body.
  [[nodiscard]] std::string scrape() const {
    const HttpSocket socket(port());
    socket.send(kRequest);
    return socket.read_to_end();
  }

  /// Value of a series; nothing when there is none.
  [[nodiscard]] static std::optional<double> value_of(const std::string& answer, const std::string& series) {
    const auto at = answer.find("\n" + series + " ");
    if (at == std::string::npos) return std::nullopt;
    return std::stod(answer.substr(at + series.size() + 2));
  }

  /// The first answer in which the series has the value, within 20 s: a job's end is told to watchers first.
  std::string scrape_until(const std::string& series, double value) const {
    std::string answer;
    EXPECT_TRUE(wait_until([&] { return value_of(answer = scrape(), series) == value; })) << series << " in\n"
                                                                                          << answer;
    return answer;
  }

  static constexpr const char* kRequest = "GET /metrics HTTP/1.0\r\n\r\n";
  SmallCluster cluster_;
};

TEST_F(MetricsTest, AJournalThatLostItsChangesIsDamaged) {
  scrape_until("cellcrush_journal_damaged", 0.0);
  daemon_.reset();
  const auto path = data_folder() / "journal.sqlite";
  store::Journal(path, [](std::int64_t) {}).create_job({}, "", "");
  store::Database(path).execute("DELETE FROM changes; DELETE FROM sqlite_sequence WHERE name = 'changes'");
  start(measured(2));
  scrape_until("cellcrush_journal_damaged", 1.0);
}

TEST_F(MetricsTest, TellJobsStepsAndTheTimeOfEachStage) {
  const std::string before = scrape();
  EXPECT_THAT(before, HasSubstr("200 OK"));
  EXPECT_EQ(value_of(before, "cellcrush_jobs_running"), 0.0);
  EXPECT_EQ(value_of(before, "cellcrush_stage_seconds_total{stage=\"find_contacts\"}"), 0.0);

  const std::string job = client().create(small_case());
  ASSERT_TRUE(client().watch(job).status.ok());
  const v1::Summary summary = client().get(job).summary();
  const std::string after = scrape_until("cellcrush_jobs_ended_total{state=\"SUCCEEDED\"}", 1.0);
  EXPECT_EQ(value_of(after, "cellcrush_steps_total"), static_cast<double>(summary.step_count()));
  const double seconds = summary.stage_times().evaluate_internal_forces_s();
  EXPECT_GT(seconds, 0.0);
  EXPECT_NEAR(value_of(after, "cellcrush_stage_seconds_total{stage=\"evaluate_internal_forces\"}").value_or(0.0),
              seconds, 1e-5 * seconds);
}

TEST_F(MetricsTest, TellWhatRunsAndItsProcess) {
  const std::string answer = scrape();
  EXPECT_THAT(answer, HasSubstr("cellcrush_build_info{revision=\"" + std::string(kSourceRevision) + "\",simd=\"" +
                                simd_target() + "\",version=\"" + kVersion + "\"} 1\n"));
  const auto now = static_cast<double>(std::time(nullptr));
  EXPECT_NEAR(value_of(answer, "process_start_time_seconds").value_or(0.0), now, 600.0);
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  const double seconds = static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
                         1e-6 * static_cast<double>(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
  EXPECT_NEAR(value_of(answer, "process_cpu_seconds_total").value_or(0.0), seconds, 0.5);
  const double resident = value_of(answer, "process_resident_memory_bytes").value_or(0.0);
  EXPECT_GT(resident, 1e6);
  EXPECT_LE(resident, 1024.0 * static_cast<double>(used.ru_maxrss));
  EXPECT_GT(value_of(answer, "process_virtual_memory_bytes").value_or(0.0), resident);
  EXPECT_GT(value_of(answer, "process_threads").value_or(0.0), 5.0);
  const double open = value_of(answer, "process_open_fds").value_or(0.0);
  rlimit limit{};
  getrlimit(RLIMIT_NOFILE, &limit);
  EXPECT_GT(open, 10.0);
  EXPECT_EQ(value_of(answer, "process_max_fds"), static_cast<double>(limit.rlim_cur));
  std::error_code error;
  const auto space = std::filesystem::space(data_folder(), error);
  EXPECT_NEAR(value_of(answer, "cellcrush_disk_free_bytes").value_or(0.0), static_cast<double>(space.available), 1e9);
  EXPECT_EQ(value_of(answer, "cellcrush_disk_kept_bytes"), 1000.0);
}

// Whoever waits, and for how long.
TEST_F(MetricsTest, TellTheOwnersAndTheAgeOfTheQueue) {
  auto client = this->client();
  const std::string owner = "{owner=\"" + access::own_user() + "\"}";
  EXPECT_EQ(value_of(scrape(), "cellcrush_queue_age_seconds"), 0.0);
  std::vector<std::string> jobs;
  for (int i = 0; i < 2; ++i) jobs.push_back(client.create(endless_case(), v1::Job::RUNNING));
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 3; ++i) jobs.push_back(client.create(tiny_case()));
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  const std::string answer = scrape_until("cellcrush_owner_jobs_waiting" + owner, 3.0);
  EXPECT_EQ(value_of(answer, "cellcrush_owner_jobs_running" + owner), 2.0);
  EXPECT_GT(value_of(answer, "cellcrush_owner_disk_bytes" + owner).value_or(0.0), 1000.0);
  const double age = value_of(answer, "cellcrush_queue_age_seconds").value_or(-1.0);
  EXPECT_GT(age, 0.25);
  EXPECT_LT(age, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() + 0.1);
  for (auto job = jobs.rbegin(); job != jobs.rend(); ++job) ASSERT_TRUE(client.cancel(*job).ok());
  scrape_until("cellcrush_queue_age_seconds", 0.0);
}

TEST_F(MetricsTest, CountFailuresByCause) {
  EXPECT_EQ(value_of(scrape(), "cellcrush_job_failures_total{cause=\"TIME_LIMIT\"}"), 0.0);
  auto request = job_of(endless_case());
  request.set_time_limit_s(0.5);
  auto client = this->client();
  const std::string job = client.create(request).name();
  ASSERT_TRUE(client.watch(job).status.ok());
  const std::string answer = scrape_until("cellcrush_job_failures_total{cause=\"TIME_LIMIT\"}", 1.0);
  EXPECT_EQ(value_of(answer, "cellcrush_jobs_ended_total{state=\"FAILED\"}"), 1.0);
  EXPECT_EQ(value_of(answer, "cellcrush_job_failures_total{cause=\"WORKER_LOST\"}"), 0.0);
  EXPECT_EQ(value_of(answer, "cellcrush_forecast_ratio_count"), 0.0) << "It did not get to its end.";
}

TEST_F(MetricsTest, HoldForecastsAgainstActualTimes) {
  auto client = this->client();
  const double predicted = [&] {
    v1::CheckCaseRequest request;
    *request.mutable_case_() = case_of_seconds();
    return answer_of(*client.cases, &v1::Cases::Stub::CheckCase, request).predicted_seconds();
  }();
  finished_job(case_of_seconds());
  const std::string answer = scrape_until("cellcrush_forecast_ratio_count", 1.0);
  EXPECT_NEAR(value_of(answer, "cellcrush_forecast_seconds_total").value_or(0.0), predicted, 0.01 * predicted);
  const double actual = value_of(answer, "cellcrush_run_seconds_total").value_or(0.0);
  EXPECT_GT(actual, 0.1);
  EXPECT_NEAR(value_of(answer, "cellcrush_forecast_ratio_sum").value_or(0.0), predicted / actual,
              0.01 * predicted / actual);
}

TEST_F(MetricsTest, CountCallsByMethodAndCode) {
  auto client = this->client();
  const std::string job = finished_job(tiny_case());
  client.history(job);
  v1::Job unused;
  EXPECT_FALSE(try_call(*client.jobs, &v1::Jobs::Stub::GetJob, named<v1::GetJobRequest>("jobs/99"), &unused).ok());
  const std::string answer = scrape_until("cellcrush_calls_total{code=\"NOT_FOUND\",method=\"Jobs/GetJob\"}", 1.0);
  EXPECT_EQ(value_of(answer, "cellcrush_calls_total{code=\"OK\",method=\"Jobs/CreateJob\"}"), 1.0);
  EXPECT_EQ(value_of(answer, "cellcrush_calls_total{code=\"OK\",method=\"Jobs/GetHistory\"}"), 1.0);
  EXPECT_EQ(value_of(answer, "cellcrush_call_seconds_count{method=\"Jobs/CreateJob\"}"), 1.0);
  EXPECT_GT(value_of(answer, "cellcrush_call_seconds_sum{method=\"Jobs/CreateJob\"}").value_or(0.0), 0.0);
  EXPECT_EQ(value_of(answer, "cellcrush_call_seconds_count{method=\"Jobs/WatchJob\"}"), std::nullopt);

  grpc::GenericStub generic(client.channel);
  const auto context = bounded_context();
  grpc::CompletionQueue queue;
  const auto call = generic.PrepareUnaryCall(context.get(), "/cellcrush.v1.Jobs/MakeUp", grpc::ByteBuffer(), &queue);
  call->StartCall();
  grpc::ByteBuffer bytes;
  grpc::Status status;
  call->Finish(&bytes, &status, nullptr);
  void* tag = nullptr;
  bool ok = false;
  queue.Next(&tag, &ok);
  EXPECT_EQ(status.error_code(), grpc::StatusCode::UNIMPLEMENTED);
  scrape_until("cellcrush_calls_total{code=\"UNIMPLEMENTED\",method=\"unknown\"}", 1.0);
}

TEST_F(MetricsTest, AddUpTheJobsOfAllExecutors) {
  DaemonOptions options = measured(2);
  options.worker_program = folder_.path() / "missing";
  options.executors.push_back(cluster_.executor("slurm/test", 1));
  start(options);
  auto client = this->client();
  client.create(tiny_case());
  auto request = job_of(tiny_case());
  request.set_executor("slurm/test");
  for (int i = 0; i < 2; ++i) client.create(request);
  scrape_until("cellcrush_queue_held{cause=\"worker\"}", 1.0);
  const std::string answer = scrape_until("cellcrush_jobs_running", 1.0);
  EXPECT_EQ(value_of(answer, "cellcrush_jobs_waiting"), 2.0) << "One on each.";
}

TEST_F(MetricsTest, AreServedBesideConnectionsThatSendOrReadNothing) {
  std::deque<HttpSocket> idle;
  for (int i = 0; i < 8; ++i) {
    idle.emplace_back(port());
    idle.emplace_back(port()).send(kRequest);
  }
  idle.emplace_back(port()).send("GET /met");
  EXPECT_THAT(scrape(), HasSubstr("cellcrush_jobs_running 0"));
}

TEST_F(MetricsTest, AreServedToThisMachineOnly) {
  DaemonOptions options = default_options();
  options.data_folder = folder_.path() / "other";
  for (const char* address : {"0.0.0.0:0", "unix:/nowhere", "127.0.0.1:port"}) {
    options.metrics = address;
    EXPECT_THROW(Daemon{options}, ServiceError) << address;
  }
  const std::string& url = daemon_->metrics_url();
  options.metrics = url.substr(7, url.rfind('/') - 7);  // taken
  EXPECT_THROW(Daemon{options}, ServiceError);
}

TEST_F(MetricsTest, TellWatchersSpeedCommitsAndEvents) {
  auto client = this->client();
  const std::string job = client.create(endless_case());
  double speed = 0.0;
  double watchers = 0.0;
  const auto context = bounded_context();
  const auto reader = client.jobs->WatchJob(context.get(), named<v1::WatchJobRequest>(job));
  v1::JobEvent event;
  const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while ((speed == 0.0 || watchers == 0.0) && std::chrono::steady_clock::now() < limit && reader->Read(&event)) {
    if (!event.has_progress()) continue;
    const std::string now = scrape();
    speed = value_of(now, "cellcrush_steps_per_second").value_or(0.0);
    watchers = value_of(now, "cellcrush_watchers").value_or(0.0);
  }
  EXPECT_GT(speed, 0.0);
  EXPECT_EQ(watchers, 1.0);
  ASSERT_TRUE(client.cancel(job).ok());
  while (reader->Read(&event)) continue;
  EXPECT_TRUE(reader->Finish().ok());
  scrape_until("cellcrush_jobs_ended_total{state=\"CANCELLED\"}", 1.0);
  const std::string after = scrape_until("cellcrush_watchers", 0.0);
  EXPECT_GE(value_of(after, "cellcrush_commit_seconds_count"), 4.0) << "Made, RUNNING, CANCELLING, CANCELLED.";
  // The progress that was read, and what came after it: news that come while a message is written count once.
  EXPECT_GE(value_of(after, "cellcrush_event_seconds_count"), 2.0);
  scrape_until("cellcrush_steps_per_second", 0.0);
}

// In one transaction all other writers would wait for all of its jobs.
TEST_F(MetricsTest, ALargeSweepIsCancelledInBatchesBetweenWhichOthersWrite) {
  auto client = this->client();
  auto first = job_of(endless_case());
  first.set_priority(100);
  for (int i = 0; i < 2; ++i) ASSERT_TRUE(client.wait_for_state(client.create(first).name(), v1::Job::RUNNING));
  std::vector<double> speeds;
  for (int i = 0; i < 4000; ++i) speeds.push_back(50.0 + 0.01 * i);
  const auto sweep = create(client, sweep_of(small_case(), kSpeed, speeds));
  const auto commits = [&] { return value_of(scrape(), "cellcrush_commit_seconds_count").value_or(0.0); };
  const double before = commits();
  const auto cancelled = cancel_sweep(client, sweep.name());
  EXPECT_GE(commits() - before, 4);
  EXPECT_EQ(count_in(cancelled, v1::Job::CANCELLED), 4000) << "No slot has taken one of them meanwhile.";
}

}  // namespace
}  // namespace cellcrush::testing
