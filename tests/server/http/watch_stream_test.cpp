// Streams over HTTP: all of the events, and no more of them in memory than the client reads.
#include <gmock/gmock.h>

#include <atomic>
#include <thread>

#include "http/gateway.h"
#include "rpc/method_table.h"
#include "server/http/http_fixture.h"
#include "server/small_case.h"

namespace cellcrush::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class HttpStreamTest : public HttpFixture {
 protected:
  void SetUp() override {
    HttpFixture::SetUp();
    start(http_options());
  }
};

std::vector<v1::JobEvent> numbered(const std::vector<v1::JobEvent>& events) {
  std::vector<v1::JobEvent> out;
  for (const auto& event : events)
    if (event.has_state() || event.has_sample()) out.push_back(event);
  return out;
}

TEST_F(HttpStreamTest, EventsInBinaryAreThoseOfGrpc) {
  auto wanted = named<v1::WatchJobRequest>(client().create(small_case()));
  const std::string answer = call("WatchJob", "application/connect+proto", envelope(wanted.SerializeAsString()));
  std::vector<v1::JobEvent> over_http;
  for (const auto& message : messages_of(dechunked(answer))) {
    v1::JobEvent event;
    ASSERT_TRUE(event.ParseFromString(message));
    over_http.push_back(event);
  }
  const auto live = numbered(over_http);
  const auto later = numbered(client().watch(wanted.name()).events);
  ASSERT_GT(live.size(), 10U);
  ASSERT_EQ(live.size(), later.size());
  for (std::size_t i = 0; i < live.size(); ++i) {
    EXPECT_EQ(live[i].sequence(), static_cast<std::int64_t>(i) + 1);
    EXPECT_EQ(live[i].SerializeAsString(), later[i].SerializeAsString()) << live[i].ShortDebugString();
  }
}

// A stream of large messages.
class Fountain {
 public:
  using Message = v1::DownloadResultResponse;
  static constexpr bool kIsWatch = false;
  static constexpr int kMessages = 1000;
  static constexpr std::size_t kSize = 64 * 1024;

  explicit Fountain(std::atomic<int>& sent) : sent_(sent) {}
  void open(const std::function<void()>&) {}
  void close() {}
  std::optional<Message> next() {
    if (ended()) return std::nullopt;
    ++sent_;
    Message out;
    out.set_data(std::string(kSize, 'x'));
    return out;
  }
  [[nodiscard]] bool has_more() const { return !ended(); }
  [[nodiscard]] bool ended() const { return sent_ == kMessages; }
  [[nodiscard]] std::optional<Message> bookmark() const { return std::nullopt; }
  [[nodiscard]] std::string resume_advice() const { return ""; }

 private:
  std::atomic<int>& sent_;
};

struct FountainService {
  std::unique_ptr<Fountain> open(const v1::DownloadResultRequest&) { return std::make_unique<Fountain>(sent); }
  std::atomic<int>& sent;
};

TEST(HttpBackpressure, NoMoreIsReadThanTheClientTakes) {
  std::atomic<int> sent = 0;
  metrics::Metrics metrics;
  rpc::StreamLimits limits({10, 10, 100'000'000});
  watch::Pump pump(2);
  access::Gate gate({});
  rpc::Accounts memory({1 << 20, 1 << 20});
  rpc::CallPool calls({1, 1, 0, 0, 1}, memory);
  rpc::MethodTable methods(gate, pump, calls, memory, {});
  methods.stream("/cellcrush.v1.Jobs/DownloadResult", access::Scope::read, {pump, calls, metrics, limits, {}},
                 std::make_shared<FountainService>(sent), &FountainService::open);
  rpc::HealthBoard board;
  http::Gateway gateway(parse_listen_address("127.0.0.1:0"), gate, methods, memory, board, {});
  const HttpSocket socket(std::stoi(gateway.url().substr(gateway.url().rfind(':') + 1)), 64 * 1024);
  const std::string body = envelope("");
  socket.send("POST /cellcrush.v1.Jobs/DownloadResult HTTP/1.1\r\nHost: " + gateway.url().substr(7) +
              "\r\nConnection: close\r\nContent-Type: application/connect+proto\r\nContent-Length: " +
              std::to_string(body.size()) + "\r\n\r\n" + body);
  int before = -1;
  for (int i = 0; i < 100 && (sent == 0 || sent != before); ++i) {
    before = sent;
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
  // The kernel keeps some megabytes; the daemon has two messages.
  EXPECT_LT(sent, 200);
  const auto messages = messages_of(dechunked(socket.read_to_end()));
  EXPECT_EQ(messages.size(), static_cast<std::size_t>(Fountain::kMessages));
}

TEST_F(HttpStreamTest, AStreamCountsForTheCallerThatItsTokenNames) {
  DaemonOptions options = with_tokens(http_options());
  options.connections.streams_per_caller = 1;
  start(options);
  const auto watch = [this](const std::string& name, const std::string& timeout) {
    return call_text("WatchJobs", "application/connect+json", envelope("{}"),
                     token_of(name) + "Connect-Timeout-Ms: " + timeout + "\r\n");
  };
  const HttpSocket socket(port());
  socket.send(watch("anna", "60000"));
  std::string got;
  while (got.find("snapshot") == std::string::npos) {
    const std::string next = socket.read_some();
    ASSERT_FALSE(next.empty()) << got;
    got += next;
  }
  EXPECT_THAT(exchange(watch("anna", "300")), HasSubstr("anna has 1 streams open"));
  EXPECT_THAT(exchange(watch("bob", "300")), AllOf(HasSubstr("snapshot"), HasSubstr("deadline_exceeded")));
}

}  // namespace
}  // namespace cellcrush::testing
