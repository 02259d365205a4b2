// Workers that get too little memory, and memory that a daemon gives back.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <fstream>
#include <iostream>
#include <set>
#include <thread>

#include "faults/fault_fixture.h"
#include "server/daemon_fixture.h"
#include "server/daemon_process.h"
#include "server/job_numbers.h"
#include "server/small_case.h"
#include "server/sweep_requests.h"
#include "worker/claim.h"

namespace cellcrush::testing {
namespace {

class LittleMemoryTest : public DaemonFixture {
 protected:
  void SetUp() override {
    std::ofstream(script()) << "#!/bin/sh\nulimit -v \"$(cat " << limit().string() << ")\"\nexec " << CELLCRUSHD_PROGRAM
                            << " \"$@\"\n";
    ASSERT_EQ(chmod(script().c_str(), 0700), 0);
    auto options = default_options();
    options.worker_program = script();
    start(options);
  }

  // For the workers that start from now on.
  void limit_memory(const std::string& kibibytes) const {
    std::ofstream file(limit(), std::ios::trunc);
    file << kibibytes << "\n";
  }

  // FAILED; or PENDING, where not even the program could be loaded, which holds the queue; or RUNNING, where there was
  // enough.
  static v1::Job::State wait_for_an_end(Client& client, const std::string& job) {
    v1::Job now;
    wait_until([&] {
      now = client.get(job);
      const bool is_held = client.queue().holds_size() > 0;
      return now.state() == v1::Job::FAILED || is_held;
    });
    return now.state();
  }

  [[nodiscard]] std::filesystem::path script() const { return folder_.path() / "worker"; }
  [[nodiscard]] std::filesystem::path limit() const { return folder_.path() / "limit"; }
};

TEST_F(LittleMemoryTest, AWorkerThatRunsOutOfMemoryFailsItsJobAndTheDaemonGoesOn) {
  auto client = this->client();
  v1::Case wide = endless_case();
  wide.mutable_lattice()->mutable_hexagon()->set_columns(200);
  wide.mutable_lattice()->mutable_hexagon()->set_rows(200);
  std::set<v1::Job::Cause> causes;
  const int step = rounds(64, 16);
  for (int mebibytes = 64; mebibytes <= 192; mebibytes += step) {
    limit_memory(std::to_string(mebibytes * 1024));
    const std::string job = client.create(wide);
    const v1::Job::State state = wait_for_an_end(client, job);
    if (state != v1::Job::FAILED) {
      std::cout << mebibytes << " MiB: " << v1::Job::State_Name(state) << "\n";
      ASSERT_TRUE(client.cancel(job).ok());
      if (state == v1::Job::PENDING) continue;
      break;
    }
    const auto failed = client.get(job);
    EXPECT_TRUE(failed.cause() == v1::Job::OUT_OF_MEMORY || failed.cause() == v1::Job::WORKER_CRASHED)
        << failed.cause();
    EXPECT_FALSE(failed.remedy().empty());
    causes.insert(failed.cause());
    std::cout << mebibytes << " MiB: " << v1::Job::Cause_Name(failed.cause()) << ", " << failed.cause_message() << "\n";
  }
  EXPECT_TRUE(causes.contains(v1::Job::OUT_OF_MEMORY));
  limit_memory("unlimited");
  const std::string next = client.create(small_case());
  expect_success(client, next);
}

// The first worker gets so little that it cannot compute the crush; those after it get what they ask for.
TEST_F(LittleMemoryTest, TheNextAttemptIsAllowedMoreAndAWorkerKeepsToItsLimit) {
  std::ofstream(script()) << "#!/bin/sh\nif rm " << limit().string() << " 2>/dev/null; then ulimit -d 40000; fi\nexec "
                          << CELLCRUSHD_PROGRAM << " \"$@\"\n";
  auto client = this->client();
  v1::Case wide = endless_case();
  wide.mutable_lattice()->mutable_hexagon()->set_columns(200);
  wide.mutable_lattice()->mutable_hexagon()->set_rows(200);
  const auto limit_of_worker = [&](const std::string& job) {
    rlimit out{};
    const pid_t worker = client.worker_of(job);
    // The limit is set once the scene is built.
    wait_until([&] { return prlimit(worker, RLIMIT_DATA, nullptr, &out) != 0 || out.rlim_cur != RLIM_INFINITY; });
    EXPECT_TRUE(client.cancel(job).ok());
    EXPECT_TRUE(client.wait_for_state(job, v1::Job::CANCELLED)) << "or a worker that writes its result takes the limit";
    return static_cast<double>(out.rlim_cur);
  };
  const double first = limit_of_worker(client.create(wide));
  limit_memory("once");
  const std::string job = client.create(wide);
  wait_until([&] { return client.get(job).attempt() == 2; });
  EXPECT_NEAR(limit_of_worker(job), 1.5 * first, 1e6);
  std::string messages;
  for (const auto& event : client.watch(job).events) messages += event.state().cause_message();
  EXPECT_THAT(messages, ::testing::HasSubstr("more than the 39 MiB of memory that it was allowed; it used "));
  EXPECT_THAT(messages, ::testing::HasSubstr("The next attempt is allowed more."));
  expect_success(client, client.create(small_case()));
}

// Polled: what it takes in its last moment is missed.
TEST_F(LittleMemoryTest, WhatAWorkerUsesIsPredictedWithin15Percent) {
  limit_memory("unlimited");
  auto client = this->client();
  for (const int rows : {5, 1000}) {
    v1::Case wide = small_case();
    wide.mutable_lattice()->mutable_hexagon()->set_rows(rows);
    wide.mutable_loading()->set_end_strain(rows == 5 ? 0.5 : 0.02);
    v1::CheckCaseRequest check;
    *check.mutable_case_() = wide;
    const auto predicted = answer_of(*client.cases, &v1::Cases::Stub::CheckCase, check).predicted_memory_bytes();
    const std::string job = client.create(wide);
    const pid_t worker = client.worker_of(job);
    std::int64_t used = 0;
    while (const std::int64_t now = worker::peak_memory_of(worker)) {
      used = std::max(used, now);
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    expect_success(client, job);
    EXPECT_NEAR(static_cast<double>(predicted), static_cast<double>(used), 0.15 * static_cast<double>(used));
  }
}

class SweepMemoryTest : public FaultFixture {
 protected:
  // A sweep of a preset, checked but not queued.
  static void check(Client& client, int points) {
    auto request = sweep_of(client.preset("hexagon-small"), kSpeed, {});
    request.set_validate_only(true);
    auto& axis = *request.mutable_sweep()->mutable_axes(0);
    axis.mutable_linear()->set_first(50.0);
    axis.mutable_linear()->set_last(150.0);
    axis.mutable_linear()->set_count(points);
    create(client, request);
  }
};

// Without being returned, the cases of 50,000 points would stay as some 370 MB. The C library keeps up to 64 MB at the
// end of the heap of each thread that has checked some.
TEST_F(SweepMemoryTest, TheCasesOfALargeSweepAreReturnedToTheSystem) {
  start_daemon();
  auto client = this->client();
  check(client, 100);
  const std::size_t before = daemon_->resident_bytes();
  const int points = rounds(50'000, 100'000);
  check(client, points);
  const std::size_t after = daemon_->resident_bytes();
  std::cout << points << " points: " << before / 1'000'000 << " MB before, " << after / 1'000'000 << " MB after\n";
  EXPECT_LT(after, before + 230'000'000);
}

}  // namespace
}  // namespace cellcrush::testing
