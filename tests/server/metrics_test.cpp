#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "error.h"
#include "server/daemon_fixture.h"
#include "server/small_case.h"
#include "server/small_cluster.h"
#include "server/sweep_requests.h"

namespace cellcrush::testing {
namespace {

using ::testing::HasSubstr;

class MetricsTest : public DaemonFixture {
 protected:
  void SetUp() override {
    DaemonOptions options = default_options();
    options.metrics = "127.0.0.1:0";
    start(options);
  }

  // The cluster outlives the daemon.
  void TearDown() override { daemon_.reset(); }

  /// A connection to the metrics, to be closed.
  [[nodiscard]] int connect_to_metrics() const {
    const std::string& url = daemon_->metrics_url();
    const std::string port = url.substr(url.rfind(':') + 1, url.rfind('/') - url.rfind(':') - 1);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(std::stoi(port)));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    EXPECT_EQ(connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0) << url;
    return socket;
  }

  static void ask_for_metrics(int socket) {
    const std::string request = "GET /metrics HTTP/1.0\r\n\r\n";
    EXPECT_EQ(write(socket, request.data(), request.size()), static_cast<ssize_t>(request.size()));
  }

  /// What a GET of the daemon's metrics answers within the limit, head and body.
  [[nodiscard]] std::string scrape(std::chrono::seconds limit = std::chrono::seconds(60)) const {
    const int socket = connect_to_metrics();
    const timeval patience{limit.count(), 0};
    setsockopt(socket, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof(patience));
    ask_for_metrics(socket);
    std::string answer;
    char piece[4096];
    for (ssize_t count = 0; (count = read(socket, piece, sizeof(piece))) > 0;)
      answer.append(piece, static_cast<std::size_t>(count));
    close(socket);
    return answer;
  }

  /// The first answer in which the series has the value, within 10 s: a job's end is told to watchers first.
  std::string scrape_until(const std::string& series, double value) const {
    std::string answer = scrape();
    for (int i = 0; i < 200 && find_value(answer, series) != value; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      answer = scrape();
    }
    EXPECT_EQ(value_of(answer, series), value);
    return answer;
  }

  /// Value of a line of the answer; nothing when there is none.
  [[nodiscard]] static std::optional<double> find_value(const std::string& answer, const std::string& series) {
    const auto at = answer.find("\n" + series + " ");
    if (at == std::string::npos) return std::nullopt;
    return std::stod(answer.substr(at + series.size() + 2));
  }

  /// The same; fails the test when there is none.
  [[nodiscard]] static double value_of(const std::string& answer, const std::string& series) {
    const auto found = find_value(answer, series);
    EXPECT_TRUE(found) << series << " in\n" << answer;
    return found.value_or(-1.0);
  }

  SmallCluster cluster_;
};

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
  EXPECT_NEAR(value_of(after, "cellcrush_stage_seconds_total{stage=\"evaluate_internal_forces\"}"), seconds,
              1e-5 * seconds);
}

TEST_F(MetricsTest, TellWhatRunsAndWaits) {
  DaemonOptions options = default_options();
  options.metrics = "127.0.0.1:0";
  options.workers = 1;
  options.data_folder = folder_.path() / "one-worker";
  start(options);
  const std::string running = client().create(endless_case());
  ASSERT_TRUE(client().wait_for_state(running, v1::Job::RUNNING));
  client().create(endless_case());
  const std::string answer = scrape();
  EXPECT_EQ(value_of(answer, "cellcrush_jobs_running"), 1.0);
  EXPECT_EQ(value_of(answer, "cellcrush_jobs_waiting"), 1.0);
  EXPECT_TRUE(client().cancel(running).ok());
  ASSERT_TRUE(client().wait_for_state(running, v1::Job::CANCELLED));
  scrape_until("cellcrush_jobs_ended_total{state=\"CANCELLED\"}", 1.0);
}

TEST_F(MetricsTest, AddUpTheJobsOfAllExecutors) {
  DaemonOptions options = default_options();
  options.metrics = "127.0.0.1:0";
  options.data_folder = folder_.path() / "two-executors";
  options.worker_program = folder_.path() / "missing";
  options.executors.push_back(cluster_.executor("slurm/test", 1));
  start(options);
  auto client = this->client();
  client.create(tiny_case());
  v1::CreateJobRequest request;
  *request.mutable_case_() = tiny_case();
  request.set_executor("slurm/test");
  for (int i = 0; i < 2; ++i) {
    v1::Job job;
    ASSERT_TRUE(client.jobs->CreateJob(bounded_context().get(), request, &job).ok());
  }
  scrape_until("cellcrush_queue_held{cause=\"worker\"}", 1.0);
  const std::string answer = scrape_until("cellcrush_jobs_running", 1.0);
  EXPECT_EQ(value_of(answer, "cellcrush_jobs_waiting"), 2.0) << "One on each.";
}

TEST_F(MetricsTest, AreServedBesideConnectionsThatSendOrReadNothing) {
  std::vector<int> idle;
  for (int i = 0; i < 8; ++i) {
    idle.push_back(connect_to_metrics());
    idle.push_back(connect_to_metrics());
    ask_for_metrics(idle.back());
  }
  // Half a request.
  idle.push_back(connect_to_metrics());
  EXPECT_EQ(write(idle.back(), "GET /met", 8), 8);
  EXPECT_THAT(scrape(std::chrono::seconds(5)), HasSubstr("cellcrush_jobs_running 0"));
  for (const int socket : idle) close(socket);
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
  v1::WatchJobRequest request;
  request.set_name(job);
  const auto reader = client.jobs->WatchJob(context.get(), request);
  v1::JobEvent event;
  const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while ((speed == 0.0 || watchers == 0.0) && std::chrono::steady_clock::now() < limit && reader->Read(&event)) {
    if (!event.has_progress()) continue;
    const std::string now = scrape();
    speed = value_of(now, "cellcrush_steps_per_second");
    watchers = value_of(now, "cellcrush_watchers");
  }
  EXPECT_GT(speed, 0.0);
  EXPECT_EQ(watchers, 1.0);
  ASSERT_TRUE(client.cancel(job).ok());
  while (reader->Read(&event)) continue;
  EXPECT_TRUE(reader->Finish().ok());
  const std::string after = scrape_until("cellcrush_watchers", 0.0);
  EXPECT_GE(value_of(after, "cellcrush_commit_seconds_count"), 4.0) << "Made, RUNNING, CANCELLING, CANCELLED.";
  // The progress that was read, and what came after it: news that come while a message is written count once.
  EXPECT_GE(value_of(after, "cellcrush_event_seconds_count"), 2.0);
  scrape_until("cellcrush_steps_per_second", 0.0);
}

// In one transaction all other writers would wait for all of its jobs.
TEST_F(MetricsTest, ALargeSweepIsCancelledInBatchesBetweenWhichOthersWrite) {
  auto client = this->client();
  v1::CreateJobRequest first;
  *first.mutable_case_() = endless_case();
  first.set_priority(100);
  v1::Job job;
  for (int i = 0; i < default_options().workers; ++i) {
    ASSERT_TRUE(client.jobs->CreateJob(bounded_context().get(), first, &job).ok());
    ASSERT_TRUE(client.wait_for_state(job.name(), v1::Job::RUNNING));
  }
  std::vector<double> speeds;
  for (int i = 0; i < 4000; ++i) speeds.push_back(50.0 + 0.01 * i);
  const auto sweep = create(client, sweep_of(small_case(), kSpeed, speeds));
  const auto commits = [&] {
    const std::string text = scrape();
    const std::string name = "cellcrush_commit_seconds_count ";
    return std::stoi(text.substr(text.find(name) + name.size()));
  };
  const int before = commits();
  v1::CancelSweepRequest request;
  request.set_name(sweep.name());
  v1::Sweep cancelled;
  ASSERT_TRUE(client.sweeps->CancelSweep(bounded_context().get(), request, &cancelled).ok());
  EXPECT_GE(commits() - before, 4);
  EXPECT_EQ(count_in(cancelled, v1::Job::CANCELLED), 4000) << "No slot has taken one of them meanwhile.";
}

}  // namespace
}  // namespace cellcrush::testing
