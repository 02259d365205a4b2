// What was acknowledged outlives a daemon that is killed at any moment and is there once; the next one serves soon.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <barrier>
#include <chrono>
#include <iostream>
#include <map>
#include <random>
#include <set>
#include <thread>

#include "faults/fault_fixture.h"
#include "server/small_case.h"
#include "store/job_state.h"
#include "store/journal_reader.h"
#include "store/result_reader.h"

namespace cellcrush::testing {
namespace {

using std::chrono::milliseconds;
using KillClock = std::chrono::steady_clock;

double seconds_since(KillClock::time_point start) {
  return std::chrono::duration<double>(KillClock::now() - start).count();
}

// A client that makes jobs, each under a request_id of its own, and asks again with the same one until it is answered.
class StubbornClient {
 public:
  StubbornClient(const std::string& address, int number)
      : client_(impatient_client(address)), number_(number), random_(static_cast<unsigned>(number)) {}

  void make_jobs_until(const std::atomic<bool>& over) {
    for (int i = 0; !over; ++i) {
      v1::CreateJobRequest request;
      *request.mutable_case_() = tiny_case();
      request.set_request_id("client-" + std::to_string(number_) + "-" + std::to_string(i));
      (*request.mutable_labels())["request"] = request.request_id();
      acknowledged[request.request_id()] = ask(request);
      std::this_thread::sleep_for(milliseconds(random_() % 400));
    }
  }

  std::map<std::string, std::string> acknowledged;  ///< request_id to job
  int repeats = 0;

 private:
  std::string ask(const v1::CreateJobRequest& request) {
    const auto limit = KillClock::now() + std::chrono::minutes(2);
    while (KillClock::now() < limit) {
      v1::Job job;
      const auto context = bounded_context(std::chrono::seconds(10));
      context->set_wait_for_ready(true);
      const auto status = client_.jobs->CreateJob(context.get(), request, &job);
      if (status.ok()) return job.name();
      EXPECT_EQ(status.error_code(), grpc::StatusCode::UNAVAILABLE) << status.error_message();
      ++repeats;
      std::this_thread::sleep_for(milliseconds(random_() % 50));
    }
    ADD_FAILURE() << request.request_id() << " was never answered";
    return "";
  }

  Client client_;
  int number_;
  std::mt19937 random_;
};

class DaemonKillTest : public FaultFixture {
 protected:
  // Kills daemons at random moments, from before they serve to a second after.
  void kill_daemons(int count) {
    std::mt19937 random(11);
    for (int i = 0; i < count; ++i) {
      begin_daemon();
      std::this_thread::sleep_for(milliseconds(random() % 1500));
      kill_daemon();
    }
  }

  static void wait_until_all_have_ended(Client& client) {
    const auto has_ended = [](const auto& job) { return store::is_terminal(job.second.state()); };
    for (int i = 0; i < 1200; ++i) {
      const auto jobs = all_jobs(client);
      if (std::all_of(jobs.begin(), jobs.end(), has_ended)) return;
      std::this_thread::sleep_for(milliseconds(500));
    }
  }

  // The journal has every event of the job once, and the folder its result alone.
  void expect_whole(store::JournalReader& reader, const std::string& job) const {
    const auto number = std::stoll(job.substr(job.find('/') + 1));
    const auto events = reader.events(number, 0, 1000);
    for (std::size_t i = 0; i < events.size(); ++i)
      ASSERT_EQ(events[i].sequence(), static_cast<std::int64_t>(i) + 1) << job;
    ASSERT_FALSE(events.empty());
    EXPECT_EQ(events.back().state().state(), v1::Job::SUCCEEDED) << job;
    const auto samples = reader.samples(number).samples;
    for (std::size_t i = 1; i < samples.size(); ++i) ASSERT_GT(samples[i].step(), samples[i - 1].step()) << job;
    EXPECT_EQ(store::ResultReader(data_folder() / job / "result.h5").history().size(), samples.size()) << job;
    for (const auto& entry : std::filesystem::directory_iterator(data_folder() / job))
      EXPECT_EQ(entry.path().filename(), "result.h5") << job;
  }
};

TEST_F(DaemonKillTest, EveryAcknowledgedJobExistsOnceAndSucceeds) {
  std::atomic<bool> over = false;
  std::vector<std::unique_ptr<StubbornClient>> clients;
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    clients.push_back(std::make_unique<StubbornClient>(address(), i));
    threads.emplace_back([&over, client = clients.back().get()] { client->make_jobs_until(over); });
  }
  const int kills = rounds(5, 200);
  kill_daemons(kills);
  start_daemon();
  over = true;
  for (auto& thread : threads) thread.join();

  std::map<std::string, std::string> acknowledged;
  int repeats = 0;
  for (const auto& one : clients) {
    acknowledged.insert(one->acknowledged.begin(), one->acknowledged.end());
    repeats += one->repeats;
  }
  auto client = this->client();
  wait_until_all_have_ended(client);
  std::map<std::string, std::string> made;
  int attempts = 0;
  for (const auto& [name, job] : all_jobs(client)) {
    EXPECT_TRUE(made.emplace(job.labels().at("request"), name).second) << "a duplicate: " << name;
    EXPECT_EQ(job.state(), v1::Job::SUCCEEDED) << name << " " << job.cause_message();
    attempts += job.attempt();
  }
  EXPECT_EQ(made, acknowledged);
  stop_daemon();
  store::JournalReader reader(journal());
  for (const auto& [id, job] : acknowledged) expect_whole(reader, job);
  std::cout << kills << " daemons killed, " << acknowledged.size() << " jobs acknowledged (" << repeats
            << " calls repeated), " << made.size() << " made by " << attempts << " workers\n";
}

// Many clients that ask for the same at the same time.
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
  const auto start = KillClock::now();
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
  const double seconds = seconds_since(start);
  const std::set<std::string> distinct(answers[0].begin(), answers[0].end());
  EXPECT_EQ(distinct.size(), static_cast<std::size_t>(ids));
  for (const auto& answer : answers) EXPECT_EQ(answer, answers[0]);
  EXPECT_EQ(all_jobs(client).size(), static_cast<std::size_t>(ids) + 1);
  std::cout << kClients << " clients, " << ids << " equal ids: " << distinct.size() << " jobs, " << kClients * ids
            << " calls in " << seconds << " s\n";
  ASSERT_TRUE(client.cancel(running).ok());
}

using RestartTest = FaultFixture;

TEST_F(RestartTest, ADaemonWithManyWaitingJobsServesSoon) {
  const int count = rounds(1000, 10'000);
  fill_journal(data_folder(), count, endless_case());
  const auto start = KillClock::now();
  start_daemon({"--workers", "1"});
  const double listening = seconds_since(start);
  auto client = this->client();
  EXPECT_EQ(client.get("jobs/" + std::to_string(count)).state(), v1::Job::PENDING);
  const double serving = seconds_since(start);
  EXPECT_TRUE(client.wait_for_state("jobs/1", v1::Job::RUNNING));
  const double running = seconds_since(start);
  EXPECT_LT(serving, is_full_round() ? 5.0 : 15.0);
  EXPECT_EQ(all_jobs(client).size(), static_cast<std::size_t>(count));
  std::cout << count << " waiting jobs: listens after " << listening << " s, serves after " << serving
            << " s, runs the first after " << running << " s\n";
}

}  // namespace
}  // namespace cellcrush::testing
