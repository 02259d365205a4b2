#include <absl/strings/str_replace.h>
#include <gmock/gmock.h>

#include <chrono>
#include <thread>

#include "http/browser_rules.h"
#include "server/http/http_fixture.h"
#include "server/small_case.h"

namespace cellcrush::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class HttpGatewayTest : public HttpFixture {
 protected:
  void SetUp() override {
    HttpFixture::SetUp();
    start(http_options());
  }
};

TEST_F(HttpGatewayTest, AUnaryCallIsAnsweredInJsonAndInBinary) {
  const std::string job = client().create(small_case());
  const std::string json = call("GetJob", "application/json", R"({"name":")" + job + "\"}");
  EXPECT_THAT(json, StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(json, HasSubstr("\"name\":\"" + job + "\""));
  auto wanted = named<v1::GetJobRequest>(job);
  const std::string binary = call("GetJob", "application/proto", wanted.SerializeAsString());
  v1::Job got;
  ASSERT_TRUE(got.ParseFromString(binary.substr(binary.find("\r\n\r\n") + 4)));
  EXPECT_EQ(got.name(), job);
}

TEST_F(HttpGatewayTest, ANoteIsWrittenInPlaceOfTheOneThatWasRead) {
  const std::string job = client().create(endless_case());
  const auto write = [&](const std::string& note, const std::string& previous) {
    return call("UpdateJob", "application/json",
                R"({"job":{"name":")" + job + R"(","note":")" + note + R"("},"updateMask":"note","previousNote":")" +
                    previous + "\"}");
  };
  EXPECT_THAT(write("first", ""), AllOf(StartsWith("HTTP/1.1 200"), HasSubstr("\"note\":\"first\"")));
  EXPECT_THAT(write("second", ""), AllOf(StartsWith("HTTP/1.1 409"), HasSubstr("aborted"), HasSubstr("first")));
  EXPECT_THAT(write("second", "first"), HasSubstr("\"note\":\"second\""));
}

TEST_F(HttpGatewayTest, ErrorsHaveTheirStatusCodeAndDetails) {
  const std::string missing = call("GetJob", "application/json", R"({"name":"jobs/99"})");
  EXPECT_THAT(missing, StartsWith("HTTP/1.1 404"));
  EXPECT_THAT(missing, HasSubstr("\"code\":\"not_found\""));
  const std::string bad = call("CreateJob", "application/json", R"({"case":{"depth_mm":-1}})");
  EXPECT_THAT(bad, StartsWith("HTTP/1.1 400"));
  EXPECT_THAT(bad, HasSubstr("\"type\":\"cellcrush.v1.ProblemList\",\"value\":\""));
  EXPECT_THAT(call("GetJob", "application/json", R"({"name":"no \"x\"\n"})"), HasSubstr(R"(no \"x\"\u000a)"));
  for (const std::string& wrong : {std::string(), std::string("ab"), envelope("{}") + "d", envelope("{}", 1)})
    EXPECT_THAT(call("WatchJob", "application/connect+json", wrong), HasSubstr("\"error\":{\"code\":")) << wrong;
  EXPECT_THAT(dechunked(call("WatchJob", "application/connect+proto", envelope("\xff"))),
              AllOf(HasSubstr("invalid_argument"), HasSubstr("is not a cellcrush.v1.WatchJobRequest")));
  EXPECT_THAT(call("GetJob", "application/json", R"({"nome":1})"), HasSubstr("nome"));
  EXPECT_THAT(call("GetJob", "application/json", "{\"name\":\"\u202e\"}"), HasSubstr(R"(\\xe2\\x80\\xae)"));
  EXPECT_THAT(call("GetJob", "application/json", "{\"name\":\"\xff\"}"), HasSubstr(R"(\\xff)"));
  EXPECT_THAT(exchange(request("GET /jobs/1/history.csv?\xff=1", "")), HasSubstr("\"\\xff=1\""));
  for (const char* none : {"/", "/cellcrush.v1.Jobs", "/cellcrush.v1.Jobs/None",
                           "/grpc.reflection.v1.ServerReflection/ServerReflectionInfo"})
    EXPECT_THAT(exchange(request(std::string("POST ") + none, "")), StartsWith("HTTP/1.1 404")) << none;
  const std::string broken = call("GetJob", "application/proto", "\xff");
  EXPECT_THAT(broken, StartsWith("HTTP/1.1 400"));
  EXPECT_THAT(broken, HasSubstr("is not a cellcrush.v1.GetJobRequest"));
  EXPECT_THAT(call("GetJob", "text/plain", "{}"), StartsWith("HTTP/1.1 415"));
  EXPECT_THAT(exchange(request("PUT /cellcrush.v1.Jobs/GetJob", "")), StartsWith("HTTP/1.1 405"));
  EXPECT_THAT(exchange(request("GET /cellcrush.v1.Jobs/GetJob", "")), StartsWith("HTTP/1.1 405"));
}

TEST_F(HttpGatewayTest, AWatchIsStreamedToItsEnd) {
  const std::string job = client().create(small_case());
  ASSERT_TRUE(client().wait_for_state(job, v1::Job::SUCCEEDED));
  const std::string body = envelope(R"({"name":")" + job + "\"}");
  const std::string got = call("WatchJob", "application/connect+json", body);
  EXPECT_THAT(got, StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(got, HasSubstr("SUCCEEDED"));
  EXPECT_THAT(got, HasSubstr(envelope("{}", 2)));
}

TEST_F(HttpGatewayTest, AClientThatGoesAwayEndsItsStream) {
  DaemonOptions options = http_options();
  options.connections.streams = 1;
  start(options);
  const std::string body = envelope(R"({"name":")" + client().create(endless_case()) + "\"}");
  for (int i = 0; i < 5; ++i) {
    {
      const HttpSocket socket(port());
      socket.send(call_text("WatchJob", "application/connect+json", body));
      std::string got;
      while (got.find("\"sequence\"") == std::string::npos) {
        const std::string next = socket.read_some();
        ASSERT_FALSE(next.empty()) << got;
        got += next;
      }
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
  }
}

TEST_F(HttpGatewayTest, OpenStreamsEndWithTheDaemon) {
  const std::string body = envelope(R"({"name":")" + client().create(endless_case()) + "\"}");
  const HttpSocket socket(port());
  socket.send(call_text("WatchJob", "application/connect+json", body));
  ASSERT_FALSE(socket.read_some().empty());
  const HttpSocket idle(port());
  daemon_->stop();
  EXPECT_THAT(socket.read_to_end(), HasSubstr("\"code\":\"unavailable\""));
  EXPECT_EQ(idle.read_to_end(), "");
}

TEST_F(HttpGatewayTest, TokensAndScopesAreThoseOfGrpc) {
  start(with_tokens(http_options()));
  EXPECT_THAT(call("ListJobs", "application/json", "{}"), StartsWith("HTTP/1.1 401"));
  EXPECT_THAT(call("ListJobs", "application/json", "{}", "Authorization: Bearer wrong\r\n"),
              StartsWith("HTTP/1.1 401"));
  const std::string reader = token_of("reader");
  EXPECT_THAT(call("ListJobs", "application/json", "{}", reader), StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(call("CancelJob", "application/json", "{}", reader), StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(call("ListJobs", "application/json", "{}", reader + reader), StartsWith("HTTP/1.1 401"));
}

TEST_F(HttpGatewayTest, ForeignPagesAndForeignMachinesAreRefused) {
  EXPECT_THAT(exchange("GET / HTTP/1.1\r\nHost: evil.example\r\nConnection: close\r\n\r\n"),
              StartsWith("HTTP/1.1 421"));
  EXPECT_THAT(call("ListJobs", "application/json", "{}", "Origin: http://evil.example\r\n"),
              StartsWith("HTTP/1.1 403"));
}

TEST_F(HttpGatewayTest, ThePageIsFoundBehindATunnelAndBelowThePathOfAnotherSite) {
  EXPECT_THAT(exchange("GET / HTTP/1.1\r\nHost: localhost:9000\r\nConnection: close\r\n\r\n"),
              AllOf(StartsWith("HTTP/1.1 200"), HasSubstr("src=\"./app.js\"")));
  DaemonOptions options = http_options();
  options.public_url = "https://site.example/node/host/8080/";
  start(options);
  const std::string host = "Host: site.example\r\nOrigin: https://site.example\r\nConnection: close\r\n";
  const std::string list = "Content-Type: application/json\r\nContent-Length: 2\r\n\r\n{}";
  for (const char* path : {"/node/host/8080", ""}) {
    const std::string before = path;
    EXPECT_THAT(exchange("GET " + before + "/jobs/3 HTTP/1.1\r\n" + host + "\r\n"),
                AllOf(StartsWith("HTTP/1.1 200"), HasSubstr("src=\"../app.js\"")));
    EXPECT_THAT(exchange("GET " + before + "/app.js HTTP/1.1\r\n" + host + "\r\n"), StartsWith("HTTP/1.1 200"));
    EXPECT_THAT(exchange("POST " + before + "/cellcrush.v1.Jobs/ListJobs HTTP/1.1\r\n" + host + list),
                StartsWith("HTTP/1.1 200"));
  }
  EXPECT_THAT(exchange("GET /node/host/8080?a=1 HTTP/1.1\r\n" + host + "\r\n"), HasSubstr("src=\"8080/app.js\""));
  EXPECT_THAT(call("ListJobs", "application/json", "{}", "Origin: https://site.example\r\n"),
              StartsWith("HTTP/1.1 200"))
      << "a proxy may name the address to which it passes";
  EXPECT_THAT(exchange("GET / HTTP/1.1\r\nHost: other.example\r\nConnection: close\r\n\r\n"),
              StartsWith("HTTP/1.1 421"));
}

// As nginx asks by default.
TEST_F(HttpGatewayTest, ToHttp10AStreamHasNoChunksAndEndsWithItsConnection) {
  const std::string job = client().create(small_case(), v1::Job::SUCCEEDED);
  const std::string body = envelope(R"({"name":")" + job + "\"}");
  const std::string got = exchange(
      "POST /cellcrush.v1.Jobs/WatchJob HTTP/1.0\r\nHost: 127.0.0.1:8080\r\n"
      "Content-Type: application/connect+json\r\nContent-Length: " +
      std::to_string(body.size()) + "\r\n\r\n" + body);
  EXPECT_THAT(got, AllOf(HasSubstr("Connection: close\r\n"), HasSubstr("X-Accel-Buffering: no\r\n"),
                         Not(HasSubstr("Transfer-Encoding"))));
  EXPECT_GE(messages_of(got.substr(got.find("\r\n\r\n") + 4)).size(), 3U);
  EXPECT_TRUE(got.ends_with(envelope("{}", 2)));
}

TEST_F(HttpGatewayTest, SlowAndLargeRequestsAreRefused) {
  DaemonOptions options = http_options();
  options.connections.handshake = std::chrono::milliseconds(300);
  start(options);
  const HttpSocket slow(port());
  slow.send("POST / HT");
  EXPECT_EQ(slow.read_to_end(), "");
  const std::string head = "POST /cellcrush.v1.Jobs/GetJob HTTP/1.1\r\nHost: localhost:" + std::to_string(port()) +
                           "\r\nContent-Type: application/json\r\n";
  EXPECT_THAT(exchange(head + "Content-Length: 5000000\r\n\r\n"), StartsWith("HTTP/1.1 413"));
  const std::string trailers = "Transfer-Encoding: chunked\r\n\r\n0\r\nX: " + std::string(100'000, 'a');
  EXPECT_THAT(exchange(head + trailers), StartsWith("HTTP/1.1 431"));
  EXPECT_THAT(exchange("POST / HTTP/1.1\r\nHost: x\r\nContent-Length: 5000000\r\n\r\n"), StartsWith("HTTP/1.1 421"))
      << "without a byte of the body";
}

TEST_F(HttpGatewayTest, ARequestThatWouldTakeTooMuchMemoryIsRefusedBeforeItIsMade) {
  std::string points;
  for (int i = 0; i < 300'000; ++i) points += "{},";
  const std::string head =
      "POST /cellcrush.v1.Sweeps/CreateSweep HTTP/1.1\r\nHost: localhost:" + std::to_string(port()) +
      "\r\nConnection: close\r\nContent-Type: application/";
  const auto post = [&](const std::string& type, const std::string& body) {
    return exchange(head + type + "\r\nContent-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body);
  };
  EXPECT_THAT(post("json", "{\"sweep\":{\"points\":[" + points + "{}]}}"), HasSubstr("has 300003 objects in JSON"));
  std::string wire = "\x0a\x80\x89\x7a";  // field 1, of 2,000,000 bytes
  for (int i = 0; i < 1'000'000; ++i) wire += std::string("\x22\0", 2);
  EXPECT_THAT(post("proto", wire), HasSubstr("sweep.points takes too much memory"));
}

TEST_F(HttpGatewayTest, NamedOriginsMayFrameThePageButNotCallMethods) {
  DaemonOptions options = http_options();
  options.framing_origins = {"https://a.example", "http://b.example:8888"};
  start(options);
  const std::string framing = "Sec-Fetch-Site: cross-site\r\nSec-Fetch-Mode: navigate\r\nSec-Fetch-Dest: iframe\r\n";
  const std::string page = exchange(request("GET /jobs/3", framing));
  EXPECT_THAT(page, StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(page, HasSubstr("frame-ancestors https://a.example http://b.example:8888\r\n"));
  EXPECT_THAT(call("GetJob", "application/json", "{}", framing), StartsWith("HTTP/1.1 403"));
}

TEST_F(HttpGatewayTest, ThePageHasItsHeaders) {
  const std::string page = exchange(request("GET /jobs/3", ""));
  EXPECT_THAT(page, StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(page, HasSubstr("frame-ancestors 'none'"));
  EXPECT_THAT(page, HasSubstr("text/html"));
  const std::string framing = "Sec-Fetch-Site: cross-site\r\nSec-Fetch-Mode: navigate\r\nSec-Fetch-Dest: iframe\r\n";
  EXPECT_THAT(exchange(request("GET /jobs/3", framing)), StartsWith("HTTP/1.1 403"));
  const auto at = page.find("ETag: ") + 6;
  const std::string tag = page.substr(at, page.find("\r\n", at) - at);
  EXPECT_THAT(exchange(request("GET /jobs/4", "If-None-Match: " + tag + "\r\n")), StartsWith("HTTP/1.1 304"));
}

TEST_F(HttpGatewayTest, OnlyPathsOfThePageGiveThePage) {
  const std::string routes = text_of_file(PAGE_ROUTES);
  const std::string begin = "route(/^";
  int views = 0;
  for (auto at = routes.find(begin); at != std::string::npos; at = routes.find(begin, at)) {
    at += begin.size();
    std::string path = routes.substr(at, routes.find("/,", at) - at);
    if (!path.ends_with('$')) continue;  // the last one, for none
    path.pop_back();
    path = absl::StrReplaceAll(path, {{"\\/", "/"}, {"(\\d+)", "12"}});
    EXPECT_THAT(exchange(request("GET " + path + "?a=b", "")), StartsWith("HTTP/1.1 200")) << path;
    ++views;
  }
  EXPECT_EQ(views, 7);
  for (const char* path : {"/foo", "/jobs/", "/jobs/x", "/jobs/1/2", "/new/", "//", "/.env", "/index"})
    EXPECT_THAT(exchange(request(std::string("GET ") + path, "")), StartsWith("HTTP/1.1 404")) << path;
}

TEST_F(HttpGatewayTest, ThePageIsCompressedForWhomAcceptsIt) {
  const std::string plain = exchange(request("GET /app.js", ""));
  const std::string small = exchange(request("GET /app.js", "Accept-Encoding: br, gzip\r\n"));
  EXPECT_THAT(plain, Not(HasSubstr("Content-Encoding: ")));
  EXPECT_THAT(small, HasSubstr("Content-Encoding: gzip\r\n"));
  for (const auto& answer : {plain, small}) EXPECT_THAT(answer, HasSubstr("Vary: Accept-Encoding\r\n"));
  EXPECT_LT(small.size(), plain.size());
}

TEST_F(HttpGatewayTest, ACallEndsAtItsTimeLimit) {
  const std::string body = envelope(R"({"name":")" + client().create(endless_case()) + "\"}");
  EXPECT_THAT(call("WatchJob", "application/connect+json", body, "Connect-Timeout-Ms: 300\r\n"),
              HasSubstr("\"code\":\"deadline_exceeded\""));
  EXPECT_THAT(call("ListJobs", "application/json", "{}", "Connect-Timeout-Ms: soon\r\n"), StartsWith("HTTP/1.1 400"));
}

TEST(HttpBrowser, PagesOfOtherSitesAreRefused) {
  const auto status = [](std::string_view host, std::string_view origin, bool has_tls = false, const char* site = "") {
    const auto refusal = http::check_browser({host, origin, site}, has_tls, {});
    return refusal ? refusal->status : 200U;
  };
  for (const char* own : {"localhost", "localhost:80", "LOCALHOST:9000", "127.0.0.1:81", "127.8.9.1:81", "[::1]:81"})
    EXPECT_EQ(status(own, std::string("http://") + own), 200U) << own;
  for (const char* foreign : {"evil.example:81", "localhost.evil.example", "127.0.0.1.evil.example:81", "localhost:x",
                              "127.evil", "[::1", "[::2]:81", "0.0.0.0:81", ""})
    EXPECT_EQ(status(foreign, ""), 421U) << foreign;
  EXPECT_EQ(status("localhost:81", "http://localhost:82"), 403U);
  EXPECT_EQ(status("localhost:81", "http://evil.example"), 403U);
  EXPECT_EQ(status("localhost:81", "null"), 403U);
  EXPECT_EQ(status("localhost:81", "", false, "cross-site"), 403U);
  EXPECT_EQ(status("crush.example:81", "https://crush.example:81", true), 200U);
  EXPECT_EQ(status("crush.example:81", "http://crush.example:81", true), 403U);
  EXPECT_EQ(status("crush.example:81", "https://evil.example", true), 403U);
}

}  // namespace
}  // namespace cellcrush::testing
