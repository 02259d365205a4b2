// Streams over HTTP: all of the events, and no more of them in memory than the client reads.
#include <gmock/gmock.h>

#include <atomic>
#include <thread>

#include "http/envelope.h"
#include "http/gateway.h"
#include "server/http/http_fixture.h"
#include "server/small_case.h"

namespace cellcrush::testing {
namespace {

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
  v1::WatchJobRequest wanted;
  wanted.set_name(client().create(small_case()));
  const std::string answer =
      call("WatchJob", "application/connect+proto", http::envelope(0, wanted.SerializeAsString()));
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

// Sends large messages as fast as they are taken.
class Fountain final : public v1::Jobs::Service {
 public:
  static constexpr int kMessages = 1000;
  static constexpr std::size_t kSize = 64 * 1024;

  grpc::Status DownloadResult(grpc::ServerContext*, const v1::DownloadResultRequest*,
                              grpc::ServerWriter<v1::DownloadResultResponse>* writer) override {
    v1::DownloadResultResponse response;
    response.set_data(std::string(kSize, 'x'));
    while (sent < kMessages && writer->Write(response)) ++sent;
    return grpc::Status::OK;
  }

  std::atomic<int> sent = 0;
};

TEST(HttpBackpressure, NoMoreIsReadThanTheClientTakes) {
  Fountain fountain;
  grpc::ServerBuilder builder;
  builder.RegisterService(&fountain);
  const auto server = builder.BuildAndStart();
  const access::Gate gate({});
  http::Gateway gateway(parse_listen_address("127.0.0.1:0"), gate, *server, {});
  const HttpSocket socket(std::stoi(gateway.url().substr(gateway.url().rfind(':') + 1)), 64 * 1024);
  const std::string body = http::envelope(0, "");
  socket.send("POST /cellcrush.v1.Jobs/DownloadResult HTTP/1.1\r\nHost: " + gateway.url().substr(7) +
              "\r\nConnection: close\r\nContent-Type: application/connect+proto\r\nContent-Length: " +
              std::to_string(body.size()) + "\r\n\r\n" + body);
  int before = -1;
  for (int i = 0; i < 100 && (fountain.sent == 0 || fountain.sent != before); ++i) {
    before = fountain.sent;
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
  // The kernel keeps some megabytes; the daemon has two messages.
  EXPECT_LT(fountain.sent, 200);
  const auto messages = messages_of(dechunked(socket.read_to_end()));
  EXPECT_EQ(messages.size(), static_cast<std::size_t>(Fountain::kMessages));
  gateway.stop();
  server->Shutdown();
}

}  // namespace
}  // namespace cellcrush::testing
