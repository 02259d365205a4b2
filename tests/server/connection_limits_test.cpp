// What callers are held to on connections and streams.
#include <gmock/gmock.h>
#include <grpcpp/generic/generic_stub.h>

#include <thread>

#include "access/unix_user.h"
#include "grpc/health/v1/health.grpc.pb.h"
#include "server/daemon_process.h"
#include "server/gate_fixture.h"
#include "server/small_case.h"

namespace cellcrush::testing {
namespace {

using grpc::health::v1::Health;
using grpc::health::v1::HealthCheckRequest;
using grpc::health::v1::HealthCheckResponse;
using std::chrono::milliseconds;
using ::testing::HasSubstr;

class ConnectionLimitsTest : public GateFixture {
 protected:
  static grpc::Status check(const std::shared_ptr<grpc::Channel>& channel) {
    HealthCheckResponse response;
    return Health::NewStub(channel)->Check(bounded_context().get(), HealthCheckRequest(), &response);
  }

  // A channel with a connection of its own.
  [[nodiscard]] std::shared_ptr<grpc::Channel> own_channel(const Visitor& visitor) const {
    if (!visitor.authority.empty()) return channel(visitor);
    grpc::ChannelArguments arguments;
    arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
    return grpc::CreateCustomChannel(daemon_->addresses().back(), grpc::InsecureChannelCredentials(), arguments);
  }

  void expect_one_caller_beyond_the_limit(const Visitor& visitor) {
    const auto first = own_channel(visitor);
    ASSERT_TRUE(try_call(*v1::Jobs::NewStub(first), &v1::Jobs::Stub::ListJobs, {}).ok()) << "no stranger from now on";
    const auto refused = check(own_channel(visitor));
    EXPECT_THAT(refused, Fails(grpc::StatusCode::RESOURCE_EXHAUSTED, "--max-connections"));
    EXPECT_TRUE(check(first).ok()) << "who is connected already is served";
    EXPECT_TRUE(check(client().channel).ok()) << "the Unix socket has places of its own";
  }
};

TEST_F(ConnectionLimitsTest, ACallerBeyondTheLimitIsGivenTheReason) {
  auto options = tcp_options();
  options.connections.connections = 1;
  start(options);
  expect_one_caller_beyond_the_limit({});
}

TEST_F(ConnectionLimitsTest, ACallerBeyondTheLimitIsGivenTheReasonOverTls) {
  auto options = with_tls(tcp_options());
  options.connections.connections_per_address = 1;
  start(options);
  Visitor visitor;
  visitor.authority = authority_.certificate();
  expect_one_caller_beyond_the_limit(visitor);
}

TEST_F(ConnectionLimitsTest, StreamsBeyondACallersLimitAreRefusedUntilOneEnds) {
  auto options = default_options();
  options.connections.streams_per_caller = 2;
  start(options);
  auto client = this->client();
  const auto request = named<v1::WatchJobRequest>(client.create(endless_case()));
  const auto one = bounded_context();
  const auto two = bounded_context();
  const auto first = client.jobs->WatchJob(one.get(), request);
  const auto second = client.jobs->WatchJob(two.get(), request);
  v1::JobEvent event;
  ASSERT_TRUE(first->Read(&event) && second->Read(&event));
  const auto three = bounded_context();
  const auto third = client.jobs->WatchJob(three.get(), request);
  EXPECT_FALSE(third->Read(&event));
  const auto refused = third->Finish();
  EXPECT_THAT(refused, Fails(grpc::StatusCode::RESOURCE_EXHAUSTED, access::own_user() + " has 2 streams open"));
  one->TryCancel();
  while (first->Read(&event)) continue;
  (void)first->Finish();
  EXPECT_TRUE(wait_until([&] {
    const auto again = bounded_context();
    const auto fourth = client.jobs->WatchJob(again.get(), request);
    const bool admitted = fourth->Read(&event);
    again->TryCancel();
    while (fourth->Read(&event)) continue;
    (void)fourth->Finish();
    return admitted;
  }));
  two->TryCancel();
}

// Long before its time, while it keeps others out; but not one that has nothing to read.
TEST_F(ConnectionLimitsTest, AStreamThatNobodyReadsIsLetGo) {
  auto options = default_options();
  options.connections.streams = 2;
  options.watch_times.patience_when_short = milliseconds(300);
  options.watch_times.grace_when_short = milliseconds(300);
  start(options);
  grpc::ChannelArguments small_window;
  small_window.SetInt(GRPC_ARG_HTTP2_BDP_PROBE, 0);
  small_window.SetInt(GRPC_ARG_HTTP2_STREAM_LOOKAHEAD_BYTES, 4096);
  Client client(daemon_->addresses().front(), small_window);
  auto with_frames = small_case();
  with_frames.mutable_output()->set_frame_count(200);
  const std::string job = client.create(with_frames, v1::Job::SUCCEEDED);
  const std::string waiting = client.create(endless_case(), v1::Job::RUNNING);
  ASSERT_TRUE(client.suspend(waiting).ok());
  const auto idle_context = bounded_context();
  Client other(daemon_->addresses().front());
  const auto idle = other.jobs->WatchJob(idle_context.get(), named<v1::WatchJobRequest>(waiting));
  v1::JobEvent event;
  ASSERT_TRUE(idle->Read(&event));
  const auto context = bounded_context();
  const auto unread = client.jobs->DownloadResult(context.get(), named<v1::DownloadResultRequest>(job));
  unread->WaitForInitialMetadata();
  // Its place is free again though its reader has done nothing.
  grpc::Status status(grpc::StatusCode::UNKNOWN, "");
  std::string result;
  EXPECT_TRUE(wait_until([&] {
    result = other.download(job, 0, status);
    EXPECT_TRUE(status.ok() || status.error_code() == grpc::StatusCode::RESOURCE_EXHAUSTED) << status.error_message();
    return status.ok();
  }));
  EXPECT_GT(result.size(), 200'000U) << "or it is read from a buffer at once";
  v1::DownloadResultResponse part;
  while (unread->Read(&part)) continue;
  EXPECT_FALSE(unread->Finish().ok());
  ASSERT_TRUE(client.cancel(waiting).ok());
  while (idle->Read(&event)) continue;
  const auto end_of_idle = idle->Finish();
  EXPECT_TRUE(end_of_idle.ok()) << end_of_idle.error_message();
}

TEST_F(ConnectionLimitsTest, AnAnswerThatNobodyReadsIsCut) {
  auto options = default_options();
  options.watch_times.patience = milliseconds(100);
  start(options);
  grpc::ChannelArguments small_window;
  small_window.SetInt(GRPC_ARG_HTTP2_BDP_PROBE, 0);
  small_window.SetInt(GRPC_ARG_HTTP2_STREAM_LOOKAHEAD_BYTES, 4096);
  Client client(daemon_->addresses().front(), small_window);
  const std::string job = client.create(small_case(), v1::Job::SUCCEEDED);
  const auto status_after = [&](milliseconds delay) {
    // A unary call whose answer is read when this test asks for it, which a stub would not do.
    grpc::CompletionQueue queue;
    const auto next = [&queue] {
      void* tag = nullptr;
      bool is_done = false;
      return queue.Next(&tag, &is_done) && is_done;
    };
    const auto context = bounded_context();
    grpc::GenericStub stub(client.channel);
    const auto call = stub.PrepareCall(context.get(), "/cellcrush.v1.Jobs/GetHistory", &queue);
    call->StartCall(nullptr);
    EXPECT_TRUE(next());
    const std::string bytes = named<v1::GetHistoryRequest>(job).SerializeAsString();
    const grpc::Slice slice(bytes);
    call->WriteLast(grpc::ByteBuffer(&slice, 1), {}, nullptr);
    EXPECT_TRUE(next());
    std::this_thread::sleep_for(delay);
    grpc::ByteBuffer answer;
    call->Read(&answer, nullptr);
    if (next()) {
      EXPECT_GT(answer.Length(), 8'192U);
    }
    grpc::Status out;
    call->Finish(&out, nullptr);
    EXPECT_TRUE(next());
    return out;
  };
  EXPECT_TRUE(status_after(milliseconds(0)).ok());
  EXPECT_FALSE(status_after(milliseconds(3000)).ok()) << "the daemon looks about once a second";
}

TEST_F(ConnectionLimitsTest, ASocketThatWasRemovedIsOpenedAgain) {
  auto options = default_options();
  options.connections.probe_interval = milliseconds(20);
  start(options);
  const auto path = folder_.path() / "socket";
  ASSERT_TRUE(std::filesystem::remove(path));
  EXPECT_TRUE(wait_until([&path] { return std::filesystem::exists(path); }));
  EXPECT_TRUE(wait_until([this] { return check(own_channel({})).ok(); }));
}

TEST_F(ConnectionLimitsTest, HealthIsWatchedUntilTheDaemonEnds) {
  start(default_options());
  auto client = this->client();
  const auto stub = Health::NewStub(client.channel);
  HealthCheckRequest request;
  request.set_service("cellcrush.v1.Jobs");
  const auto context = bounded_context();
  const auto reader = stub->Watch(context.get(), request);
  HealthCheckResponse response;
  ASSERT_TRUE(reader->Read(&response));
  EXPECT_EQ(response.status(), HealthCheckResponse::SERVING);
  request.set_service("cellcrush.v1.None");
  const auto other = bounded_context();
  const auto unknown = stub->Watch(other.get(), request);
  ASSERT_TRUE(unknown->Read(&response));
  EXPECT_EQ(response.status(), HealthCheckResponse::SERVICE_UNKNOWN);
  EXPECT_EQ(stub->Check(bounded_context().get(), request, &response).error_code(), grpc::StatusCode::NOT_FOUND);
  std::jthread end([this] { daemon_->stop(); });
  ASSERT_TRUE(reader->Read(&response));
  EXPECT_EQ(response.status(), HealthCheckResponse::NOT_SERVING);
  EXPECT_FALSE(reader->Read(&response));
  EXPECT_EQ(reader->Finish().error_code(), grpc::StatusCode::UNAVAILABLE);
}

}  // namespace
}  // namespace cellcrush::testing
