#include "rpc/source_stream.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <future>
#include <thread>

#include "cellcrush/v1/jobs_service.pb.h"
#include "server/daemon_process.h"

namespace cellcrush::rpc {
namespace {

using Batch = MessageStream::Batch;
using testing::wait_until;

/// What the test sees of a source of a thousand messages, of which the first takes half a second.
struct Tap {
  std::atomic<int> begun = 0;
  std::atomic<int> given = 0;
  std::atomic<bool> is_open = false;
};

class TapSource {
 public:
  using Message = v1::DownloadResultResponse;
  static constexpr bool kIsWatch = true;

  explicit TapSource(Tap& tap) : tap_(tap) {}
  void open(const std::function<void()>&) { tap_.is_open = true; }
  void close() { tap_.is_open = false; }
  std::optional<Message> next() {
    if (tap_.begun++ == 0) std::this_thread::sleep_for(std::chrono::milliseconds(500));
    ++tap_.given;
    return Message();
  }
  [[nodiscard]] bool has_more() const { return false; }
  [[nodiscard]] bool ended() const { return tap_.given == 1000; }
  [[nodiscard]] Message bookmark() const { return {}; }
  [[nodiscard]] std::string resume_advice() const { return ""; }

 private:
  Tap& tap_;
};

TEST(SourceStream, CancellingWaitsForNoBatchThatIsBeingMade) {
  Tap tap;
  metrics::Metrics metrics;
  StreamLimits limits({10, 2, 100'000'000});
  watch::Pump pump(2);
  const auto stream = std::make_shared<SourceStream<TapSource>>(
      StreamParts{pump, metrics, limits, {}}, "anna",
      [](const google::protobuf::Message& each, std::string& to) { to += each.SerializeAsString(); },
      [&tap] { return std::make_unique<TapSource>(tap); });
  auto promise = std::make_shared<std::promise<Batch>>();
  auto batch = promise->get_future();
  stream->ask([promise = std::move(promise)](Batch made) { promise->set_value(std::move(made)); });
  ASSERT_TRUE(wait_until([&] { return tap.begun == 1; }));
  const auto before = std::chrono::steady_clock::now();
  stream->cancel();
  EXPECT_LT(std::chrono::steady_clock::now() - before, std::chrono::milliseconds(400));
  EXPECT_TRUE(wait_until([&] { return !tap.is_open && limits.count() == 0; }));
  EXPECT_EQ(tap.given, 1) << "The rest of the batch was not made.";
  EXPECT_THROW(batch.get(), std::future_error) << "Nothing was delivered.";
}

}  // namespace
}  // namespace cellcrush::rpc
