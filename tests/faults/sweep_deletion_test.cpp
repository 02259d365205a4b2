// A sweep that is deleted while the daemon is killed is gone in the end, whole and alone.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <iostream>
#include <thread>

#include "faults/fault_fixture.h"
#include "server/small_case.h"
#include "server/sweep_requests.h"

namespace cellcrush::testing {
namespace {

class SweepDeletionTest : public FaultFixture {
 protected:
  // A sweep of so many points, all of which are cancelled before they run.
  static std::string make_ended_sweep(Client& client, int points) {
    auto request = sweep_of(tiny_case(), "plates.friction", {});
    auto& values = *request.mutable_sweep()->mutable_axes(0)->mutable_list()->mutable_values();
    for (int i = 0; i < points; ++i) values.Add(0.0001 * i);
    std::string name = create(client, request).name();
    EXPECT_EQ(count_in(cancel_sweep(client, name), v1::Job::CANCELLED), points);
    return name;
  }

  static grpc::StatusCode delete_sweep(Client& client, const std::string& name) {
    v1::DeleteSweepResponse response;
    const auto context = bounded_context();
    context->set_wait_for_ready(true);
    return client.sweeps->DeleteSweep(context.get(), named<v1::DeleteSweepRequest>(name), &response).error_code();
  }
};

TEST_F(SweepDeletionTest, ADaemonThatIsKilledMeanwhileIsContinuedByTheNext) {
  int torn = 0;
  const int count = rounds(3, 30);
  const int points = 1000;
  for (int i = 0; i < count; ++i) {
    start_daemon({"--workers", "1"});
    auto client = this->client();
    const std::string running = client.create(endless_case(), v1::Job::RUNNING);
    const std::string kept = client.create(tiny_case());
    const std::string name = make_ended_sweep(client, points);
    auto code = grpc::StatusCode::OK;
    {
      const std::jthread caller([this, &name, &code] {
        auto own = this->client();
        code = delete_sweep(own, name);
      });
      // Until the deletion has begun; in each round until more of the jobs are gone.
      const std::size_t left = static_cast<std::size_t>(points + 1 - i * points / (2 * count));
      for (int step = 0; step < 1000 && all_jobs(client).size() > left; ++step)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      kill_daemon();
      // The caller asks the next one, or was answered.
      start_daemon({"--workers", "1"});
    }
    torn += code != grpc::StatusCode::OK;
    auto next = this->client();
    wait_until([&next] { return all_jobs(next).size() <= 2; }, std::chrono::seconds(30));
    const auto left = all_jobs(next);
    EXPECT_EQ(left.size(), 2U);
    EXPECT_TRUE(left.contains(running) && left.contains(kept));
    EXPECT_EQ(delete_sweep(next, name), grpc::StatusCode::NOT_FOUND);
    // First the one that waits: it would run once the other has gone.
    for (const auto& job : {kept, running}) {
      EXPECT_TRUE(next.cancel(job).ok());
      EXPECT_TRUE(next.wait_for_state(job, v1::Job::CANCELLED));
      EXPECT_TRUE(next.remove(job).ok());
    }
    stop_daemon();
  }
  EXPECT_GT(torn, 0);
  std::cout << count << " deletions of a sweep of " << points << " jobs, " << torn << " of them torn by a kill\n";
}

}  // namespace
}  // namespace cellcrush::testing
