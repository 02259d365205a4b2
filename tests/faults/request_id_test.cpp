// Many clients that ask for the same at the same time.
#include <gtest/gtest.h>

#include <barrier>
#include <chrono>
#include <iostream>
#include <set>
#include <thread>

#include "faults/fault_fixture.h"
#include "server/small_case.h"

namespace cellcrush::testing {
namespace {

class RequestIdTest : public FaultFixture {
 protected:
  // Asks for all ids in their order; the names that were answered.
  static std::vector<std::string> ask_for_all(const std::string& address, int ids) {
    std::vector<std::string> out;
    auto client = impatient_client(address);
    for (int i = 0; i < ids; ++i) {
      auto request = job_of(tiny_case());
      request.set_request_id("request-" + std::to_string(i));
      out.push_back(client.create(request).name());
    }
    return out;
  }
};

TEST_F(RequestIdTest, EqualIdsOfManyClientsMakeOneJobEach) {
  start_daemon({"--workers", "1"});
  // Holds the only worker, so that no other job runs.
  auto client = this->client();
  const std::string running = client.create(endless_case());
  constexpr int kClients = 64;
  const int ids = rounds(50, 1000);
  std::vector<std::vector<std::string>> answers(static_cast<std::size_t>(kClients));
  std::barrier together(kClients);
  const auto start = std::chrono::steady_clock::now();
  {
    std::vector<std::jthread> threads;
    threads.reserve(answers.size());
    for (auto& answer : answers) {
      threads.emplace_back([&] {
        together.arrive_and_wait();
        answer = ask_for_all(address(), ids);
      });
    }
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const std::set<std::string> distinct(answers[0].begin(), answers[0].end());
  EXPECT_EQ(distinct.size(), static_cast<std::size_t>(ids));
  for (const auto& answer : answers) EXPECT_EQ(answer, answers[0]);
  EXPECT_EQ(all_jobs(client).size(), static_cast<std::size_t>(ids) + 1);
  std::cout << kClients << " clients, " << ids << " equal ids: " << distinct.size() << " jobs, " << kClients * ids
            << " calls in " << seconds << " s\n";
  ASSERT_TRUE(client.cancel(running).ok());
}

}  // namespace
}  // namespace cellcrush::testing
