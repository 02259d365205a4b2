// Watches that are torn, and resumed with the number of the last event seen.
#include <gmock/gmock.h>

#include <atomic>
#include <chrono>
#include <iostream>
#include <random>
#include <thread>

#include "faults/fault_fixture.h"
#include "server/small_case.h"
#include "server/watch_contract.h"
#include "store/journal_reader.h"
#include "translate/case_words.h"

namespace cellcrush::testing {
namespace {

using std::chrono::milliseconds;

// Watches a job in pieces, to its end.
class TornWatcher {
 public:
  TornWatcher(const std::string& address, std::string job, unsigned seed)
      : client_(impatient_client(address)), job_(std::move(job)), random_(seed) {}

  void watch() {
    const auto limit = std::chrono::steady_clock::now() + std::chrono::minutes(10);
    while (std::chrono::steady_clock::now() < limit) {
      if (watch_a_piece()) return;
      ++tears;
      std::this_thread::sleep_for(milliseconds(random_() % 50));
    }
    ADD_FAILURE() << "The watch of " << job_ << " did not come to an end";
  }

  std::vector<v1::JobEvent> numbered;
  std::vector<std::string> broken;
  int tears = 0;

 private:
  // Whether the watch ended with OK.
  bool watch_a_piece() {
    v1::WatchJobRequest request;
    request.set_name(job_);
    request.set_after_sequence(after_);
    request.set_frames(random_() % 2 == 0);
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + milliseconds(20 + random_() % 3000));
    context.set_wait_for_ready(true);
    const auto reader = client_.jobs->WatchJob(&context, request);
    WatchContract contract(after_);
    v1::JobEvent event;
    const int most = static_cast<int>(random_() % 100);
    for (int i = 0; i < most && reader->Read(&event); ++i) contract.see(event);
    // What had come already and was not seen comes again.
    if (!contract.job_ended()) context.TryCancel();
    while (reader->Read(&event)) continue;
    const auto status = reader->Finish();
    EXPECT_TRUE(status.ok() || status.error_code() == grpc::StatusCode::CANCELLED ||
                status.error_code() == grpc::StatusCode::DEADLINE_EXCEEDED ||
                status.error_code() == grpc::StatusCode::UNAVAILABLE)
        << status.error_message();
    contract.end(contract.job_ended() ? status : grpc::Status::CANCELLED);
    after_ = contract.sequence();
    numbered.insert(numbered.end(), contract.numbered().begin(), contract.numbered().end());
    broken.insert(broken.end(), contract.broken().begin(), contract.broken().end());
    return contract.job_ended();
  }

  Client client_;
  std::string job_;
  std::mt19937 random_;
  std::int64_t after_ = 0;
};

class TornWatchTest : public FaultFixture {
 protected:
  void expect_the_journals(const std::vector<v1::JobEvent>& seen, std::int64_t job) {
    store::JournalReader reader(journal());
    auto truth = reader.events(job, 0, 1'000'000);
    ASSERT_EQ(seen.size(), truth.size());
    for (std::size_t i = 0; i < truth.size(); ++i) {
      translate::add_words(truth[i]);
      ASSERT_EQ(seen[i].SerializeAsString(), truth[i].SerializeAsString()) << "event " << i + 1;
    }
  }
};

TEST_F(TornWatchTest, TornAndResumedWatchesHaveEveryEventOfTheJournalOnceAndInOrder) {
  const std::vector<std::string> arguments = {"--workers", "2"};
  start_daemon(arguments);
  std::vector<std::string> jobs;
  {
    auto client = this->client();
    for (int i = 0; i < rounds(2, 4); ++i) jobs.push_back(client.create(case_of_seconds()));
  }
  std::vector<std::unique_ptr<TornWatcher>> watchers;
  std::vector<std::thread> threads;
  const int count = rounds(20, 200);
  for (int i = 0; i < count; ++i) {
    const auto& job = jobs[static_cast<std::size_t>(i) % jobs.size()];
    watchers.push_back(std::make_unique<TornWatcher>(address(), job, static_cast<unsigned>(i)));
    threads.emplace_back([watcher = watchers.back().get()] { watcher->watch(); });
  }
  const int kills = rounds(1, 5);
  for (int i = 0; i < kills; ++i) {
    std::this_thread::sleep_for(milliseconds(1500));
    kill_daemon();
    start_daemon(arguments);
  }
  for (auto& thread : threads) thread.join();
  stop_daemon();
  int tears = 0;
  std::size_t events = 0;
  for (std::size_t i = 0; i < watchers.size(); ++i) {
    EXPECT_THAT(watchers[i]->broken, ::testing::IsEmpty());
    expect_the_journals(watchers[i]->numbered, std::stoll(jobs[i % jobs.size()].substr(5)));
    tears += watchers[i]->tears;
    events += watchers[i]->numbered.size();
  }
  EXPECT_GT(tears, count);
  std::cout << count << " watchers torn " << tears << " times and " << kills << " daemons killed: " << events
            << " events, none lost, none twice, none out of order\n";
}

}  // namespace
}  // namespace cellcrush::testing
