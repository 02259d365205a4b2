#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <thread>
#include <tuple>

#include "programs/temporary_folder.h"
#include "server/job_numbers.h"
#include "server/small_case.h"
#include "server/sweep_requests.h"

namespace cellcrush::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class JobOrderTest : public DaemonFixture {
 protected:
  // One worker, so that jobs start one after another.
  void SetUp() override { start(with_workers(1)); }

  static std::string create_with_priority(Client& client, int priority) {
    auto request = job_of(endless_case());
    request.set_priority(priority);
    const auto job = client.create(request);
    EXPECT_EQ(job.priority(), priority);
    return job.name();
  }

  // The jobs, all endless, in the order in which they start. Each is cancelled once it runs.
  static std::vector<std::string> by_start(Client& client, std::vector<std::string> jobs) {
    std::vector<std::string> out;
    for (int i = 0; i < 1200 && !jobs.empty(); ++i) {
      const auto running = std::find_if(jobs.begin(), jobs.end(), [&client](const std::string& job) {
        return client.get(job).state() == v1::Job::RUNNING;
      });
      if (running == jobs.end()) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        continue;
      }
      EXPECT_TRUE(client.cancel(*running).ok());
      out.push_back(*running);
      jobs.erase(running);
    }
    return out;
  }
};

TEST_F(JobOrderTest, TheJobsOfASweepStartLongestFirst) {
  auto client = this->client();
  // At half the speed a crush has twice the steps.
  const auto of_few_samples = with_text(endless_case(), "output { sample_count: 100 }");
  const auto sweep = create(client, sweep_of(of_few_samples, kSpeed, {4.0, 2.0, 1.0, 2.5}));
  EXPECT_THAT(by_start(client, {sweep.jobs().begin(), sweep.jobs().end()}),
              ElementsAre("jobs/3", "jobs/2", "jobs/4", "jobs/1"));
}

TEST_F(JobOrderTest, TheNextDaemonStartsTheRestInTheSameOrder) {
  {
    auto client = this->client();
    const std::string running = client.create(endless_case());
    create(client, sweep_of(endless_case(), kSpeed, {4.0, 1.0, 2.0}));
    client.create(endless_case());
    create_with_priority(client, 12);
    ASSERT_TRUE(client.wait_for_state(running, v1::Job::RUNNING));
  }
  daemon_->stop();
  start(with_workers(1));
  auto client = this->client();
  client.cancel("jobs/1");
  EXPECT_THAT(by_start(client, {"jobs/2", "jobs/3", "jobs/4", "jobs/5", "jobs/6"}),
              ElementsAre("jobs/6", "jobs/3", "jobs/4", "jobs/2", "jobs/5"));
}

TEST_F(JobOrderTest, AJobOfAHigherPriorityStartsBeforeOlderOnesAndStopsNone) {
  auto client = this->client();
  const std::string running = client.create(endless_case(), v1::Job::RUNNING);
  auto request = sweep_of(endless_case(), kSpeed, {1.0, 2.0});
  request.mutable_sweep()->set_priority(-1);
  const auto sweep = create(client, request);
  EXPECT_EQ(sweep.priority(), -1);
  EXPECT_EQ(client.get(sweep.jobs(0)).priority(), -1);
  const std::string plain = client.create(endless_case());
  const std::string urgent = create_with_priority(client, 100);
  EXPECT_EQ(client.get(running).state(), v1::Job::RUNNING);
  ASSERT_TRUE(client.cancel(running).ok());
  EXPECT_THAT(by_start(client, {sweep.jobs(0), sweep.jobs(1), plain, urgent}),
              ElementsAre(urgent, plain, sweep.jobs(0), sweep.jobs(1)));
}

TEST_F(JobOrderTest, TheQueueTellsTheOrderInWhichJobsStartAndWhyTheyWait) {
  auto client = this->client();
  EXPECT_EQ(client.queue().entries_size(), 0);
  const std::string running = client.create(endless_case(), v1::Job::RUNNING);
  auto request = sweep_of(endless_case(), kSpeed, {4.0, 1.0, 2.0});
  request.mutable_sweep()->set_max_parallel(1);
  create(client, request);
  const std::string plain = client.create(endless_case());
  const std::string urgent = create_with_priority(client, 7);
  const auto queue = client.queue();
  std::vector<std::string> told;
  double before = 0.0;
  for (const auto& entry : queue.entries()) {
    told.push_back(entry.job());
    EXPECT_GT(entry.seconds_until_start(), before) << entry.job();
    before = entry.seconds_until_start();
  }
  EXPECT_EQ(queue.more_count(), 0);
  ASSERT_THAT(told, ElementsAre(urgent, "jobs/3", "jobs/4", "jobs/2", plain));
  EXPECT_EQ(queue.entries(0).priority(), 7);
  EXPECT_EQ(queue.entries(0).reason(), "The only worker is busy.");
  EXPECT_EQ(queue.entries(3).reason(), "The only worker is busy, and 3 jobs start before it.");
  ASSERT_TRUE(client.cancel(running).ok());
  EXPECT_EQ(by_start(client, told), told);
  EXPECT_EQ(client.queue().entries_size(), 0);
}

TEST_F(JobOrderTest, APriorityOutOfRangeIsRefused) {
  auto client = this->client();
  auto request = job_of(small_case());
  request.set_priority(101);
  const auto status = client.try_to(request);
  EXPECT_THAT(status, Fails(grpc::StatusCode::INVALID_ARGUMENT, "priority is 101. Use -100 to 100"));
  auto sweep = sweep_of(small_case(), kSpeed, {100.0});
  sweep.mutable_sweep()->set_priority(-101);
  EXPECT_THAT(client.try_to(sweep).error_message(), HasSubstr("sweep.priority is -101"));
}

TEST_F(JobOrderTest, AThousandSpeedsSeedsOrSizesOfTypeIAreQueuedTogether) {
  auto client = this->client();
  auto of_type_i = client.preset("type-i");
  of_type_i.mutable_lattice()->mutable_imperfection()->set_amplitude_mm(0.01);
  for (const auto& [field, first, last] : {std::tuple(kSpeed, 20.0, 220.0),
                                           {"lattice.imperfection.seed", 1.0, 1000.0},
                                           {"lattice.hexagon.wall_thickness_mm", 0.1, 0.6},
                                           {"lattice.hexagon.side_mm", 3.0, 6.0}}) {
    auto request = sweep_of(of_type_i, field, {});
    auto& values = *request.mutable_sweep()->mutable_axes(0)->mutable_linear();
    values.set_first(first);
    values.set_last(last);
    values.set_count(1000);
    const auto sweep = create(client, request);
    EXPECT_EQ(sweep.jobs_size(), 1000) << field;
    cancel_sweep(client, sweep.name());
  }
}

TEST_F(JobOrderTest, AQueueIsToldOfAlsoWhenASampleOfAJobInItCannotBeRead) {
  auto client = this->client();
  const std::string damaged = create_with_samples(client, endless_case(), 5);
  ASSERT_TRUE(client.suspend(damaged).ok());
  const std::string running = client.create(endless_case(), v1::Job::RUNNING);
  flip_bits(data_folder() / damaged / "reports", 40);
  ASSERT_TRUE(client.resume(damaged).ok());
  const auto queue = client.queue();
  ASSERT_EQ(queue.entries_size(), 1);
  EXPECT_EQ(queue.entries(0).job(), damaged);
}

}  // namespace
}  // namespace cellcrush::testing
