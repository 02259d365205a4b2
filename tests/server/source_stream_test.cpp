#include "rpc/source_stream.h"

#include <gmock/gmock.h>

#include <atomic>
#include <chrono>
#include <future>
#include <thread>

#include "cellcrush/v1/jobs_service.pb.h"
#include "error.h"

namespace cellcrush::rpc {
namespace {

using ::testing::HasSubstr;
using Batch = MessageStream::Batch;

constexpr int kBookmark = 77;
constexpr std::size_t kMessage = 1000;  // bytes of data

/// What the tests do to a source, and what they see of it.
struct Tap {
  std::atomic<int> left = 0;  ///< messages
  std::atomic<int> given = 0;
  std::atomic<int> bookmarks = 0;
  std::atomic<bool> is_slow = false;  ///< the next message takes half a second
  std::atomic<bool> is_open = false;
  std::function<void()> wake;
};

class TapSource {
 public:
  using Message = v1::DownloadResultResponse;
  static constexpr bool kIsWatch = true;

  explicit TapSource(Tap& tap) : tap_(tap) {}
  void open(std::function<void()> wake) {
    tap_.wake = std::move(wake);
    tap_.is_open = true;
  }
  void close() { tap_.is_open = false; }
  std::optional<Message> next() {
    if (tap_.left <= 0) return std::nullopt;
    --tap_.left;
    if (tap_.is_slow.exchange(false)) std::this_thread::sleep_for(std::chrono::milliseconds(500));
    Message out;
    out.set_offset(++tap_.given);
    out.set_data(std::string(kMessage, 'x'));
    return out;
  }
  [[nodiscard]] bool has_more() const { return false; }
  [[nodiscard]] bool ended() const { return tap_.left < 0; }
  [[nodiscard]] Message bookmark() const {
    ++tap_.bookmarks;
    Message out;
    out.set_offset(kBookmark);
    return out;
  }
  [[nodiscard]] std::string resume_advice() const { return "with the next offset"; }

 private:
  Tap& tap_;
};

class SourceStreamTest : public ::testing::Test {
 protected:
  std::shared_ptr<MessageStream> open(std::int64_t offset = 0) {
    const auto make = [this, offset] {
      if (offset < 0) throw ServiceError(ServiceError::Kind::out_of_range, "There is no such byte.");
      return std::make_unique<TapSource>(tap_);
    };
    const auto encode = [](const google::protobuf::Message& each, std::string& to) { to += each.SerializeAsString(); };
    return std::make_shared<SourceStream<TapSource>>(
        StreamParts{pump_, metrics_, limits_, {kUntilBookmark, kPatience, {}}}, "anna", encode, make);
  }

  static std::future<Batch> ask(MessageStream& stream) {
    auto promise = std::make_shared<std::promise<Batch>>();
    auto out = promise->get_future();
    stream.ask([promise](Batch batch) { promise->set_value(std::move(batch)); });
    return out;
  }

  static Batch next(MessageStream& stream) { return ask(stream).get(); }

  // Waits at most 10 s.
  template <class Condition>
  static bool comes_true(const Condition& condition) {
    for (int i = 0; i < 1000 && !condition(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return condition();
  }

  static constexpr std::chrono::milliseconds kPatience{300};
  static constexpr std::chrono::milliseconds kUntilBookmark{1500};
  Tap tap_;
  metrics::Metrics metrics_;
  StreamLimits limits_{{10, 2, 100'000'000}};
  watch::Pump pump_{2};
};

TEST_F(SourceStreamTest, NoMoreIsMadeThanIsAskedFor) {
  tap_.left = 1000;
  const auto stream = open();
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_EQ(tap_.given, 0);
  const auto first = next(*stream);
  EXPECT_LT(first.bytes.size(), 70'000U);
  const int given = tap_.given;
  EXPECT_GT(given, 50);
  EXPECT_LT(given, 70);
  tap_.wake();
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_EQ(tap_.given, given);
  std::size_t bytes = first.bytes.size();
  while (tap_.left > 0) bytes += next(*stream).bytes.size();
  EXPECT_EQ(tap_.given, 1000);
  EXPECT_GT(bytes, 1000 * kMessage);
  stream->cancel();
}

TEST_F(SourceStreamTest, ABatchComesOnceThereIsSomething) {
  const auto stream = open();
  auto batch = ask(*stream);
  ASSERT_TRUE(comes_true([&] { return tap_.is_open.load(); }));
  EXPECT_EQ(batch.wait_for(std::chrono::milliseconds(50)), std::future_status::timeout);
  tap_.left = 3;
  tap_.wake();
  v1::DownloadResultResponse last;
  ASSERT_TRUE(last.ParseFromString(batch.get().bytes));
  EXPECT_EQ(last.offset(), 3);
  auto end = ask(*stream);
  tap_.left = -1;
  tap_.wake();
  EXPECT_TRUE(end.get().end->ok());
  EXPECT_FALSE(tap_.is_open);
}

TEST_F(SourceStreamTest, AClientThatReadsNothingLosesItsStreamButNotTheReason) {
  tap_.left = 1;
  const auto stream = open();
  EXPECT_FALSE(next(*stream).bytes.empty());
  EXPECT_EQ(limits_.count(), 1U);
  EXPECT_TRUE(comes_true([&] { return limits_.count() == 0; }));
  EXPECT_FALSE(tap_.is_open);
  const auto end = next(*stream).end;
  ASSERT_TRUE(end);
  EXPECT_EQ(end->error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  EXPECT_THAT(end->error_message(), HasSubstr("Ask again with the next offset"));
}

TEST_F(SourceStreamTest, ACancelledStreamIsClosedAndDeliversNothing) {
  const auto stream = open();
  auto batch = ask(*stream);
  ASSERT_TRUE(comes_true([&] { return tap_.is_open.load(); }));
  stream->cancel();
  EXPECT_TRUE(comes_true([&] { return !tap_.is_open && limits_.count() == 0; }));
  EXPECT_THROW(batch.get(), std::future_error) << "Nobody keeps the promise.";
}

TEST_F(SourceStreamTest, CancellingWaitsForNoBatchThatIsBeingMade) {
  const auto stream = open();
  auto batch = ask(*stream);
  ASSERT_TRUE(comes_true([&] { return tap_.is_open.load(); }));
  tap_.is_slow = true;
  tap_.left = 1000;
  tap_.wake();
  ASSERT_TRUE(comes_true([&] { return !tap_.is_slow; }));
  const auto before = std::chrono::steady_clock::now();
  stream->cancel();
  EXPECT_LT(std::chrono::steady_clock::now() - before, std::chrono::milliseconds(400));
  EXPECT_TRUE(comes_true([&] { return !tap_.is_open && limits_.count() == 0; }));
  EXPECT_EQ(tap_.given, 1) << "The rest of the batch was not made.";
  EXPECT_THROW(batch.get(), std::future_error) << "Nothing was delivered.";
}

TEST_F(SourceStreamTest, RefusalsEndTheStream) {
  EXPECT_EQ(next(*open(-1)).end->error_code(), grpc::StatusCode::OUT_OF_RANGE);
  tap_.left = 1000;
  const auto first = open();
  const auto second = open();
  next(*first);
  next(*second);
  EXPECT_THAT(next(*open()).end->error_message(), HasSubstr("anna has 2 streams open"));
  first->cancel();
  second->cancel();
}

TEST_F(SourceStreamTest, AnIdleStreamGetsOneBookmark) {
  const auto stream = open();
  auto batch = ask(*stream);
  ASSERT_EQ(batch.wait_for(std::chrono::seconds(20)), std::future_status::ready);
  v1::DownloadResultResponse got;
  ASSERT_TRUE(got.ParseFromString(batch.get().bytes));
  EXPECT_EQ(got.offset(), kBookmark);
  EXPECT_EQ(tap_.bookmarks, 1);
  stream->cancel();
}

TEST_F(SourceStreamTest, StreamsEndWithTheDaemon) {
  const auto stream = open();
  auto batch = ask(*stream);
  ASSERT_TRUE(comes_true([&] { return tap_.is_open.load(); }));
  pump_.drain();
  EXPECT_EQ(batch.get().end->error_code(), grpc::StatusCode::UNAVAILABLE);
}

}  // namespace
}  // namespace cellcrush::rpc
