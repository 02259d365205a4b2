// A watcher that reads one message a second.
#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <thread>

#include "faults/fault_fixture.h"
#include "server/job_numbers.h"
#include "server/small_case.h"
#include "server/watch_contract.h"
#include "store/journal_reader.h"

namespace cellcrush::testing {
namespace {

using std::chrono::seconds;

class SlowWatcherTest : public FaultFixture {
 protected:
  static std::unique_ptr<grpc::ClientReader<v1::JobEvent>> watch(Client& client, grpc::ClientContext& context,
                                                                 const std::string& job) {
    v1::WatchJobRequest request;
    request.set_name(job);
    request.set_frames(true);
    return client.jobs->WatchJob(&context, request);
  }
};

TEST_F(SlowWatcherTest, CostsTheDaemonNoMemoryAndAnotherWatcherNoEvent) {
  start_daemon({"--workers", "1"});
  auto client = this->client();
  // A quick machine runs the endless one to its end in a minute.
  auto submitted = endless_case();
  submitted.mutable_loading()->set_speed_m_per_s(0.2);
  const std::string job = client.create(submitted);
  WatchContract quick;
  std::jthread other([&] {
    auto own = this->client();
    const auto watched = own.watch(job, 0, true, [&](const v1::JobEvent& event) { quick.see(event); });
    quick.end(watched.status);
    EXPECT_TRUE(watched.status.ok()) << watched.status.error_message();
  });
  // The daemon's caches are filled first.
  wait_for_samples(client, job, 500);
  std::this_thread::sleep_for(seconds(rounds(2, 20)));

  const std::size_t before = daemon_->resident_bytes();
  std::size_t most = before;
  const auto context = bounded_context(seconds(600));
  auto slow_client = this->client();
  const auto reader = watch(slow_client, *context, job);
  WatchContract slow;
  v1::JobEvent event;
  const int messages = rounds(4, 120);
  for (int i = 0; i < messages; ++i) {
    ASSERT_TRUE(reader->Read(&event));
    slow.see(event);
    std::this_thread::sleep_for(seconds(1));
    most = std::max(most, daemon_->resident_bytes());
  }
  const double grown = static_cast<double>(most - before) / 1048576.0;
  ASSERT_TRUE(client.cancel(job).ok());
  other.join();
  context->TryCancel();
  EXPECT_LT(grown, 8.0);
  EXPECT_THAT(slow.broken(), ::testing::IsEmpty());
  EXPECT_THAT(quick.broken(), ::testing::IsEmpty());
  stop_daemon();
  store::JournalReader truth(journal());
  const std::size_t events = truth.events(1, 0, 10'000'000).size();
  EXPECT_EQ(quick.numbered().size(), events);
  const auto behind = static_cast<std::int64_t>(events) - slow.sequence();
  EXPECT_GT(behind, 100 + messages) << "It was no slow watcher.";
  std::cout << "a message a second for " << messages << " s, " << behind << " events behind: the daemon grew by "
            << grown << " MiB, another watcher had all " << quick.numbered().size() << " events\n";
}

}  // namespace
}  // namespace cellcrush::testing
