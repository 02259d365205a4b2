#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "http/envelope.h"
#include "server/gate_fixture.h"
#include "server/small_case.h"

namespace cellcrush::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class HttpGatewayTest : public GateFixture {
 protected:
  void SetUp() override {
    GateFixture::SetUp();
    start(http_options());
  }

  [[nodiscard]] DaemonOptions http_options() const {
    DaemonOptions options = default_options();
    options.http = "127.0.0.1:0";
    return options;
  }

  [[nodiscard]] std::string port() const { return daemon_->http_url().substr(daemon_->http_url().rfind(':') + 1); }

  [[nodiscard]] int connect_to_gateway() const {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(std::stoi(port())));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const int out = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const timeval patience{60, 0};
    setsockopt(out, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof(patience));
    EXPECT_EQ(connect(out, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
    return out;
  }

  static void send_text(int socket, const std::string& text) {
    EXPECT_EQ(::send(socket, text.data(), text.size(), MSG_NOSIGNAL), static_cast<ssize_t>(text.size()));
  }

  static std::string read_to_end(int socket) {
    std::string out;
    char piece[4096];
    for (ssize_t count = 0; (count = read(socket, piece, sizeof(piece))) > 0;)
      out.append(piece, static_cast<std::size_t>(count));
    close(socket);
    return out;
  }

  [[nodiscard]] std::string request(const std::string& line, const std::string& headers,
                                    const std::string& body = "") const {
    return line + " HTTP/1.1\r\nHost: 127.0.0.1:" + port() + "\r\nConnection: close\r\n" + headers +
           "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body;
  }

  [[nodiscard]] std::string exchange(const std::string& text) const {
    const int socket = connect_to_gateway();
    send_text(socket, text);
    return read_to_end(socket);
  }

  [[nodiscard]] std::string call(const std::string& method, const std::string& type, const std::string& body,
                                 const std::string& headers = "") const {
    return exchange(request("POST /cellcrush.v1.Jobs/" + method, "Content-Type: " + type + "\r\n" + headers, body));
  }
};

TEST_F(HttpGatewayTest, AUnaryCallIsAnsweredInJsonAndInBinary) {
  const std::string job = client().create(small_case());
  const std::string json = call("GetJob", "application/json", R"({"name":")" + job + "\"}");
  EXPECT_THAT(json, StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(json, HasSubstr("\"name\":\"" + job + "\""));
  v1::GetJobRequest wanted;
  wanted.set_name(job);
  const std::string binary = call("GetJob", "application/proto", wanted.SerializeAsString());
  v1::Job got;
  ASSERT_TRUE(got.ParseFromString(binary.substr(binary.find("\r\n\r\n") + 4)));
  EXPECT_EQ(got.name(), job);
}

TEST_F(HttpGatewayTest, ErrorsHaveTheirStatusCodeAndDetails) {
  const std::string missing = call("GetJob", "application/json", R"({"name":"jobs/99"})");
  EXPECT_THAT(missing, StartsWith("HTTP/1.1 404"));
  EXPECT_THAT(missing, HasSubstr("\"code\":\"not_found\""));
  const std::string bad = call("CreateJob", "application/json", R"({"case":{"depth_mm":-1}})");
  EXPECT_THAT(bad, StartsWith("HTTP/1.1 400"));
  EXPECT_THAT(bad, HasSubstr("\"type\":\"cellcrush.v1.ProblemList\""));
  EXPECT_THAT(call("GetJob", "application/json", R"({"nome":1})"), HasSubstr("nome"));
  EXPECT_THAT(call("None", "application/json", "{}"), StartsWith("HTTP/1.1 404"));
  EXPECT_THAT(call("GetJob", "text/plain", "{}"), StartsWith("HTTP/1.1 415"));
  EXPECT_THAT(exchange(request("PUT /cellcrush.v1.Jobs/GetJob", "")), StartsWith("HTTP/1.1 405"));
  EXPECT_THAT(exchange(request("GET /cellcrush.v1.Jobs/GetJob", "")), StartsWith("HTTP/1.1 405"));
}

TEST_F(HttpGatewayTest, AWatchIsStreamedToItsEnd) {
  const std::string job = client().create(small_case());
  ASSERT_TRUE(client().wait_for_state(job, v1::Job::SUCCEEDED));
  const std::string body = http::envelope(0, R"({"name":")" + job + "\"}");
  const std::string got = call("WatchJob", "application/connect+json", body);
  EXPECT_THAT(got, StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(got, HasSubstr("SUCCEEDED"));
  EXPECT_THAT(got, HasSubstr(http::envelope(http::kEndOfStream, "{}")));
}

TEST_F(HttpGatewayTest, AClientThatGoesAwayEndsItsStream) {
  DaemonOptions options = http_options();
  options.connections.streams = 1;
  start(options);
  const std::string body = http::envelope(0, R"({"name":")" + client().create(endless_case()) + "\"}");
  for (int i = 0; i < 5; ++i) {
    const int socket = connect_to_gateway();
    send_text(socket, request("POST /cellcrush.v1.Jobs/WatchJob", "Content-Type: application/connect+json\r\n", body));
    char piece[1024];
    std::string got;
    while (got.find("\"sequence\"") == std::string::npos) {
      const ssize_t count = read(socket, piece, sizeof(piece));
      ASSERT_GT(count, 0) << got;
      got.append(piece, static_cast<std::size_t>(count));
    }
    close(socket);
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
  }
}

TEST_F(HttpGatewayTest, OpenStreamsEndWithTheDaemon) {
  const std::string body = http::envelope(0, R"({"name":")" + client().create(endless_case()) + "\"}");
  const int socket = connect_to_gateway();
  send_text(socket, request("POST /cellcrush.v1.Jobs/WatchJob", "Content-Type: application/connect+json\r\n", body));
  char first = 0;
  ASSERT_EQ(read(socket, &first, 1), 1);
  const int idle = connect_to_gateway();
  daemon_->stop();
  EXPECT_THAT(read_to_end(socket), HasSubstr("\"code\":\"unavailable\""));
  EXPECT_EQ(read_to_end(idle), "");
}

TEST_F(HttpGatewayTest, TokensAndScopesAreThoseOfGrpc) {
  start(with_tokens(http_options()));
  EXPECT_THAT(call("ListJobs", "application/json", "{}"), StartsWith("HTTP/1.1 401"));
  EXPECT_THAT(call("ListJobs", "application/json", "{}", "Authorization: Bearer wrong\r\n"),
              StartsWith("HTTP/1.1 401"));
  const std::string reader = "Authorization: Bearer " + tokens_.at("reader") + "\r\n";
  EXPECT_THAT(call("ListJobs", "application/json", "{}", reader), StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(call("CancelJob", "application/json", "{}", reader), StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(call("ListJobs", "application/json", "{}", reader + reader), StartsWith("HTTP/1.1 401"));
}

TEST_F(HttpGatewayTest, ForeignPagesAndForeignMachinesAreRefused) {
  EXPECT_THAT(exchange("GET / HTTP/1.1\r\nHost: evil.example\r\nConnection: close\r\n\r\n"),
              StartsWith("HTTP/1.1 421"));
  EXPECT_THAT(call("ListJobs", "application/json", "{}", "Origin: http://evil.example\r\n"),
              StartsWith("HTTP/1.1 403"));
  DaemonOptions options = http_options();
  options.http = "0.0.0.0:0";
  EXPECT_THAT(refusal_of_start(options), HasSubstr("loopback"));
  EXPECT_THAT(refusal_of_start(with_tls(http_options())), HasSubstr("--http none"));
}

TEST_F(HttpGatewayTest, SlowAndLargeRequestsAreRefused) {
  DaemonOptions options = http_options();
  options.connections.handshake = std::chrono::milliseconds(300);
  start(options);
  const int slow = connect_to_gateway();
  send_text(slow, "POST / HT");
  EXPECT_EQ(read_to_end(slow), "");
  const std::string head = "POST /cellcrush.v1.Jobs/GetJob HTTP/1.1\r\nHost: x\r\nContent-Length: 5000000\r\n\r\n";
  EXPECT_THAT(exchange(head), StartsWith("HTTP/1.1 413"));
}

TEST_F(HttpGatewayTest, ThePageHasItsHeaders) {
  const std::string page = exchange(request("GET /jobs/3", ""));
  EXPECT_THAT(page, StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(page, HasSubstr("frame-ancestors 'none'"));
  EXPECT_THAT(page, HasSubstr("text/html"));
  const auto at = page.find("ETag: ") + 6;
  const std::string tag = page.substr(at, page.find("\r\n", at) - at);
  EXPECT_THAT(exchange(request("GET /", "If-None-Match: " + tag + "\r\n")), StartsWith("HTTP/1.1 304"));
}

}  // namespace
}  // namespace cellcrush::testing
