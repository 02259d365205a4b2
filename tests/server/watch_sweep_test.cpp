#include <map>
#include <set>

#include "server/small_case.h"
#include "server/sweep_requests.h"

namespace cellcrush::testing {
namespace {

class WatchSweepTest : public DaemonFixture {
 protected:
  // Notes the numbered events of each job; each must be the next of its job.
  static void note(const std::vector<v1::WatchSweepResponse>& responses, std::map<std::string, std::int64_t>& seen) {
    for (const auto& response : responses) {
      EXPECT_FALSE(response.event().has_frame());
      const auto& event = response.event();
      if (event.has_state() || event.has_sample()) {
        ASSERT_EQ(event.sequence(), ++seen[response.job()]) << response.job();
      }
    }
  }

  // What each job's own watch counts.
  std::map<std::string, std::int64_t> expected(const v1::Sweep& sweep) {
    auto client = this->client();
    std::map<std::string, std::int64_t> out;
    for (const auto& job : sweep.jobs()) out[job] = client.watch(job).events.back().sequence();
    return out;
  }
};

TEST_F(WatchSweepTest, ASweepIsWatchedFromItsBeginningToTheEndOfItsLastJob) {
  auto client = this->client();
  const auto sweep = create(client, sweep_of(small_case(), kSpeed, {50.0, 100.0, 200.0}));
  const auto watched = watch_sweep(client, sweep.name());
  EXPECT_TRUE(watched.status.ok()) << watched.status.error_message();
  ASSERT_FALSE(watched.responses.empty());
  EXPECT_TRUE(watched.responses.front().job().empty());
  EXPECT_EQ(watched.responses.front().snapshot().jobs_size(), 3);
  std::map<std::string, std::int64_t> seen;
  note(watched.responses, seen);
  EXPECT_EQ(seen, expected(sweep));
  std::set<std::string> ended;
  std::set<std::string> begun;
  for (const auto& response : watched.responses) {
    const bool first = begun.insert(response.job()).second;
    const bool is_snapshot = response.has_snapshot() || response.event().has_snapshot();
    EXPECT_EQ(first, is_snapshot) << "Every job's snapshot comes first, and once.";
    if (response.event().state().state() == v1::Job::SUCCEEDED) ended.insert(response.job());
  }
  EXPECT_EQ(ended.size(), 3U);
}

TEST_F(WatchSweepTest, AWatchGoesOnWhereAnotherWasCutOff) {
  auto client = this->client();
  const auto sweep = create(client, sweep_of(small_case(), kSpeed, {50.0, 100.0, 200.0}));
  std::map<std::string, std::int64_t> seen;
  std::string token;
  for (const int tokens : {1, 20, 50, 70, -1}) {
    const auto watched = watch_sweep(client, sweep.name(), token, tokens);
    EXPECT_TRUE(watched.responses.front().has_snapshot());
    note(watched.responses, seen);
    // Every numbered event comes with a token, so the last one stands for all that was read.
    for (const auto& response : watched.responses) {
      if (!response.resume_token().empty()) token = response.resume_token();
    }
    EXPECT_EQ(watched.status.ok(), tokens < 0) << watched.status.error_message();
  }
  EXPECT_EQ(seen, expected(sweep));
  const auto nothing = watch_sweep(client, sweep.name(), token);
  EXPECT_TRUE(nothing.status.ok());
  EXPECT_EQ(nothing.responses.size(), 1U);
}

TEST_F(WatchSweepTest, ATokenOutlivesTheDaemon) {
  auto options = default_options();
  options.workers = 1;
  start(options);
  std::map<std::string, std::int64_t> seen;
  std::string token;
  v1::Sweep sweep;
  {
    auto client = this->client();
    sweep = create(client, sweep_of(small_case(), kSpeed, {50.0, 60.0, 70.0, 80.0}));
    const auto watched = watch_sweep(client, sweep.name(), "", 120);
    note(watched.responses, seen);
    token = watched.responses.back().resume_token();
  }
  daemon_->stop();
  start(options);
  auto client = this->client();
  const auto rest = watch_sweep(client, sweep.name(), token);
  EXPECT_TRUE(rest.status.ok()) << rest.status.error_message();
  note(rest.responses, seen);
  EXPECT_EQ(seen, expected(sweep));
}

TEST_F(WatchSweepTest, AnIdleWatchGetsBookmarksAndAWrongTokenIsRefused) {
  auto options = default_options();
  options.watch_times.bookmark_interval = std::chrono::milliseconds(200);
  options.workers = 1;
  start(options);
  auto client = this->client();
  const std::string running = client.create(endless_case());
  const auto sweep = create(client, sweep_of(small_case(), kSpeed, {50.0}));
  const auto job_context = bounded_context();
  const auto job_reader = client.jobs->WatchJob(job_context.get(), named<v1::WatchJobRequest>(sweep.jobs(0)));
  v1::JobEvent event;
  do {
    ASSERT_TRUE(job_reader->Read(&event));
  } while (!event.has_bookmark());
  EXPECT_EQ(event.sequence(), 1);
  job_context->TryCancel();
  const auto request = named<v1::WatchSweepRequest>(sweep.name());
  const auto context = bounded_context();
  const auto reader = client.sweeps->WatchSweep(context.get(), request);
  v1::WatchSweepResponse response;
  do {
    ASSERT_TRUE(reader->Read(&response));
  } while (!response.event().has_bookmark());
  EXPECT_TRUE(response.job().empty());
  EXPECT_FALSE(response.resume_token().empty());
  context->TryCancel();
  EXPECT_EQ(watch_sweep(client, sweep.name(), "nonsense").status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(watch_sweep(client, sweep.name(), "1:2+1=900;").status.error_code(), grpc::StatusCode::OUT_OF_RANGE);
}

}  // namespace
}  // namespace cellcrush::testing
