// Callers take turns: with the threads that advance streams, and with those that answer calls.
#include <gmock/gmock.h>

#include <atomic>
#include <future>
#include <string>
#include <vector>

#include "metrics/metrics.h"
#include "rpc/source_stream.h"
#include "server/daemon_process.h"
#include "server/held_point.h"
#include "watch/pump.h"

namespace cellcrush::rpc {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using testing::HeldPoint;
using testing::wait_until;

/// Who had a turn, in order. Thread-safe.
class Turns {
 public:
  void add(const std::string& name) {
    const MutexLock lock(mutex_);
    names_.push_back(name);
  }
  [[nodiscard]] std::vector<std::string> names() const {
    const MutexLock lock(mutex_);
    return names_;
  }

 private:
  mutable Mutex mutex_;
  std::vector<std::string> names_;
};

struct Step final : watch::Pump::Task {
  Step(const std::string& caller, std::function<void()> given) : Task(caller), act(std::move(given)) {}
  void run() override { act(); }
  std::function<void()> act;
};

TEST(Pump, CallersTakeTurnsAndNoneHasAllThreads) {
  Turns turns;
  HeldPoint held;
  watch::Pump pump(2);
  const auto step = [&](const std::string& caller, const std::string& name) {
    pump.schedule(std::make_shared<Step>(caller, [&turns, &held, name] {
      if (name == "anna 1") held.stand();
      turns.add(name);
    }));
  };
  step("anna", "anna 1");
  ASSERT_TRUE(held.wait());
  step("anna", "anna 2");
  step("bob", "bob 1");
  EXPECT_TRUE(wait_until([&] { return turns.names().size() == 1; }));
  EXPECT_THAT(turns.names(), ElementsAre("bob 1")) << "Anna's first task holds her thread, and not the other one.";
  held.open();
  EXPECT_TRUE(wait_until([&] { return turns.names().size() == 3; }));
  EXPECT_THAT(turns.names(), ElementsAre("bob 1", "anna 1", "anna 2"));
}

/// A source whose preparation is held.
class SlowSource final : public PlainSource<v1::DownloadResultResponse> {
 public:
  SlowSource(HeldPoint& point, std::atomic<bool>& was_wanted) : point_(point), was_wanted_(was_wanted) {}
  void prepare(const Call& call) {
    point_.stand();
    was_wanted_ = !call.is_cancelled();
    is_prepared_ = true;
  }
  [[nodiscard]] static bool is_large() { return true; }
  std::optional<Message> next() {
    EXPECT_TRUE(is_prepared_);
    is_sent_ = true;
    Message out;
    out.set_total_size(7);
    return out;
  }
  [[nodiscard]] bool ended() const { return is_sent_; }
  [[nodiscard]] static std::string resume_advice() { return ""; }

 private:
  HeldPoint& point_;
  std::atomic<bool>& was_wanted_;
  bool is_prepared_ = false;
  bool is_sent_ = false;
};

/// A stream of a slow source, beside its pump of one thread.
struct SlowStream {
  SlowStream() {
    stream->ask([this](MessageStream::Batch made) { batch.set_value(std::move(made)); });
    EXPECT_TRUE(point.wait());
  }

  HeldPoint point;
  std::atomic<bool> was_wanted = false;
  std::promise<MessageStream::Batch> batch;
  metrics::Metrics metrics;
  StreamLimits limits{{10, 2, 100'000'000}};
  Accounts memory{{1 << 20, 1 << 20}};
  watch::Pump pump{1};
  CallPool checks{{1, 1, 1, 1, 1}, memory};
  std::shared_ptr<SourceStream<SlowSource>> stream = std::make_shared<SourceStream<SlowSource>>(
      StreamParts{pump, checks, metrics, limits, {}}, "anna",
      [](const google::protobuf::Message& each, std::string& to) { to += each.SerializeAsString(); },
      [this] { return std::make_unique<SlowSource>(point, was_wanted); });
};

TEST(SourceStream, WhatASourcePreparesHoldsNoThreadOfTheStreams) {
  SlowStream slow;
  std::promise<void> beat;
  slow.pump.post([&] { beat.set_value(); });
  EXPECT_EQ(beat.get_future().wait_for(std::chrono::seconds(30)), std::future_status::ready);
  slow.point.open();
  EXPECT_THAT(slow.batch.get_future().get().bytes, ::testing::Not(IsEmpty()));
  EXPECT_TRUE(slow.was_wanted);
}

TEST(SourceStream, WhatASourcePreparesEndsWithItsReader) {
  SlowStream slow;
  slow.stream->cancel();
  EXPECT_TRUE(wait_until([&] { return slow.limits.count() == 0; }));
  slow.point.open();
  slow.checks.stop();
  EXPECT_FALSE(slow.was_wanted);
}

/// A pool of calls of two threads, one for each caller, and one large call at once.
class CallPoolTest : public ::testing::Test {
 protected:
  struct TestCall final : Call {
    [[nodiscard]] access::Caller caller() const override { return {}; }
    [[nodiscard]] bool is_cancelled() const override { return is_gone; }
    std::atomic<bool> is_gone = false;
  };

  CallPool::Task task(const std::string& caller, const std::string& name, HeldPoint* point = nullptr) {
    CallPool::Task out{.call = std::make_shared<TestCall>(), .caller = caller};
    out.body = [this, name, point](CallPool::Task&) {
      if (point != nullptr) point->stand();
      turns_.add(name);
    };
    out.finish = [this, name](const grpc::Status& status, auto) {
      if (!status.ok()) ends_.add(name + ": " + status.error_message());
    };
    return out;
  }

  void run_large(CallPool::Task task) {
    task.is_large = true;
    pool_.run(std::move(task));
  }

  Turns turns_;
  Turns ends_;
  Accounts memory_{{1000, 600}};
  HeldPoint held_;
  HeldPoint held_small_;
  CallPool pool_{{2, 1, 1, 1, 3}, memory_};
};

TEST_F(CallPoolTest, CallersTakeTurnsAndSmallCallsComeBeforeLargeOnes) {
  run_large(task("anna", "large 1", &held_));
  ASSERT_TRUE(held_.wait());
  pool_.run(task("dora", "dora", &held_small_));
  ASSERT_TRUE(held_small_.wait()) << "Both threads are busy until all have come.";
  run_large(task("bob", "large 2"));
  pool_.run(task("anna", "anna"));
  pool_.run(task("bob", "bob 1"));
  pool_.run(task("bob", "bob 2"));
  pool_.run(task("carl", "carl"));
  held_small_.open();
  EXPECT_TRUE(wait_until([&] { return turns_.names().size() == 4; }));
  EXPECT_THAT(turns_.names(), ElementsAre("dora", "bob 1", "carl", "bob 2")) << "Bob's large call waits for Anna's.";
  held_.open();
  pool_.stop();
  EXPECT_THAT(turns_.names(),
              ::testing::UnorderedElementsAre("dora", "bob 1", "carl", "bob 2", "large 1", "large 2", "anna"));
}

TEST_F(CallPoolTest, ACallerWaitsForItsOwnMemoryAndForItsOwnPlacesOnly) {
  auto first = task("anna", "first", &held_);
  first.bytes = 600;
  pool_.run(std::move(first));
  ASSERT_TRUE(held_.wait());
  for (int i = 0; i < 4; ++i) pool_.run(task("anna", "more"));
  EXPECT_THAT(ends_.names(), ElementsAre(::testing::HasSubstr("3 calls of anna are waiting")));
  auto other = task("bob", "bob");
  other.bytes = 400;
  pool_.run(std::move(other));
  EXPECT_TRUE(wait_until([&] { return turns_.names().size() == 1; }));
  EXPECT_THAT(turns_.names(), ElementsAre("bob"));
  held_.open();
  pool_.stop();
  EXPECT_THAT(turns_.names(), ElementsAre("bob", "first", "more", "more", "more"));
}

TEST_F(CallPoolTest, ACallWhoseClientHasGoneIsNotAnswered) {
  pool_.run(task("anna", "first", &held_));
  ASSERT_TRUE(held_.wait());
  auto gone = task("anna", "gone");
  const_cast<TestCall&>(dynamic_cast<const TestCall&>(*gone.call)).is_gone = true;
  pool_.run(std::move(gone));
  held_.open();
  pool_.stop();
  EXPECT_THAT(turns_.names(), ElementsAre("first"));
  EXPECT_THAT(ends_.names(), ElementsAre("gone: The client cancelled the call."));
}

}  // namespace
}  // namespace cellcrush::rpc
