// Where HTTP is served, to whom and to how many.
#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <openssl/ssl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <memory>
#include <set>
#include <vector>

#include "log_format.h"
#include "server/http/http_fixture.h"
#include "server/log_capture.h"

namespace cellcrush::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

// Ciphers that a port takes, of all that OpenSSL has.
std::set<std::string> ciphers_of(int port) {
  const auto make_context = [] {
    return std::unique_ptr<SSL_CTX, decltype(&SSL_CTX_free)>(SSL_CTX_new(TLS_client_method()), &SSL_CTX_free);
  };
  const auto all = make_context();
  SSL_CTX_set_cipher_list(all.get(), "ALL:@SECLEVEL=0");
  const auto* list = SSL_CTX_get_ciphers(all.get());
  std::set<std::string> out;
  for (int i = 0; i < sk_SSL_CIPHER_num(list); ++i) {
    const auto* cipher = sk_SSL_CIPHER_value(list, i);
    const std::string name = SSL_CIPHER_get_name(cipher);
    const bool is_new = std::string(SSL_CIPHER_get_version(cipher)) == "TLSv1.3";
    const auto context = make_context();
    SSL_CTX_set_cipher_list(context.get(), ((is_new ? "ALL" : name) + ":@SECLEVEL=0").c_str());
    if (is_new) SSL_CTX_set_ciphersuites(context.get(), name.c_str());
    is_new ? SSL_CTX_set_min_proto_version(context.get(), TLS1_3_VERSION)
           : SSL_CTX_set_max_proto_version(context.get(), TLS1_2_VERSION);
    const HttpSocket socket(port);
    const std::unique_ptr<SSL, decltype(&SSL_free)> tls(SSL_new(context.get()), &SSL_free);
    SSL_set_fd(tls.get(), socket.number());
    if (SSL_connect(tls.get()) == 1) out.insert(name);
  }
  return out;
}

class HttpPortTest : public HttpFixture {
 protected:
  [[nodiscard]] std::string list_with_tls(const Visitor& visitor, const std::string& headers = "") const {
    return exchange_with_tls(port(), visitor, call_text("ListJobs", "application/json", "{}", headers));
  }

  [[nodiscard]] DaemonOptions with_client_authority(DaemonOptions options) const {
    options.access.tls_client_authority = authority_.certificate();
    return options;
  }
};

TEST_F(HttpPortTest, AnAddressThatOthersReachNeedsTlsAndTokens) {
  DaemonOptions open = http_options();
  open.http = "0.0.0.0:0";
  EXPECT_THAT(refusal_of_start(open), AllOf(HasSubstr("--tls-cert FILE --tls-key FILE"), HasSubstr("--tokens FILE"),
                                            HasSubstr("--http 127.0.0.1:8080")));
  EXPECT_THAT(refusal_of_start(with_tokens(open)), HasSubstr("--tls-cert FILE"));
  EXPECT_THAT(refusal_of_start(with_tls(open)), HasSubstr("--tokens FILE"));
  EXPECT_THAT(refusal_of_start(with_tls(with_client_authority(http_options()))),
              AllOf(HasSubstr("--tokens FILE"), HasSubstr("--http none")));
  DaemonOptions wrong = http_options();
  for (const char* address : {"unix:/tmp/socket", "8080"}) {
    wrong.http = address;
    EXPECT_THAT(refusal_of_start(wrong), HasSubstr("use --http HOST:PORT")) << address;
  }
  EXPECT_FALSE(std::filesystem::exists(data_folder())) << "Nothing is opened before.";
  EXPECT_EQ(refusal_of_start(with_tokens(with_tls(open))), "");
}

TEST_F(HttpPortTest, TheDefaultPortIsOffWithClientCertificatesAlone) {
  const LogCapture log(make_text_formatter());
  DaemonOptions options = with_client_authority(with_tls(default_options()));
  options.http.clear();
  start(options);
  EXPECT_EQ(daemon_->http_url(), "");
  EXPECT_EQ(log.count_lines("not serving HTTP"), 1) << log.text();
}

TEST_F(HttpPortTest, WhereTheDefaultPortIsTakenAFreeOneServesThePage) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(8080);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const int taken = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  static_cast<void>(bind(taken, reinterpret_cast<const sockaddr*>(&address), sizeof(address)));
  listen(taken, 1);  // or another program listens there already
  const LogCapture log(make_text_formatter());
  DaemonOptions options = default_options();
  options.http.clear();
  start(options);
  EXPECT_THAT(daemon_->http_url(), AllOf(StartsWith("http://127.0.0.1:"), ::testing::Not(HasSubstr(":8080"))));
  EXPECT_EQ(log.count_lines("[info] 127.0.0.1:8080 is taken, so the page is served on a free port"), 1) << log.text();
  EXPECT_THAT(call("ListJobs", "application/json", "{}"), StartsWith("HTTP/1.1 200"));
  options.listen = {"unix:" + (folder_.path() / "left").string()};
  options.http = "127.0.0.1:8080";
  EXPECT_THAT(refusal_of_start(options), HasSubstr("another address with --http"));
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "left")) << "It has closed what it had opened.";
  close(taken);
}

TEST_F(HttpPortTest, AtTheLimitTheOldestStrangerIsClosed) {
  DaemonOptions options = http_options();
  options.connections.connections = 3;
  options.connections.connections_per_address = 2;
  start(options);
  const HttpSocket first(port());
  const HttpSocket second(port());
  EXPECT_THAT(call("ListJobs", "application/json", "{}"), StartsWith("HTTP/1.1 200"));
  EXPECT_EQ(first.read_to_end(), "");
}

TEST_F(HttpPortTest, ThousandsOfConnectionsOfOneMachineHoldUpNoOther) {
  constexpr int kConnections = 2'000;
  rlimit files{};
  getrlimit(RLIMIT_NOFILE, &files);
  if (files.rlim_max < 4'000) GTEST_SKIP() << "A process may open " << files.rlim_max << " files only.";
  start(http_options());  // raises the limit of this process
  std::vector<std::unique_ptr<HttpSocket>> idle;
  idle.reserve(kConnections);
  for (int i = 0; i < kConnections; ++i) idle.push_back(std::make_unique<HttpSocket>(port()));
  EXPECT_EQ(idle.front()->read_to_end(), "") << "One machine may have 500; the oldest make room.";
  for (int i = 0; i < 50; ++i) {
    const HttpSocket other(port(), 0, "127.0.0.2");
    other.send(call_text("ListJobs", "application/json", "{}"));
    ASSERT_THAT(other.read_to_end(), StartsWith("HTTP/1.1 200"));
  }
}

TEST_F(HttpPortTest, HttpsTakesTheCiphersOfGrpc) {
  DaemonOptions options = with_tls(http_options());
  options.listen = {"127.0.0.1:0"};
  start(options);
  const std::string grpc = daemon_->addresses().front();
  const auto ciphers = ciphers_of(port());
  EXPECT_GE(ciphers.size(), 4U);
  EXPECT_EQ(ciphers, ciphers_of(std::stoi(grpc.substr(grpc.rfind(':') + 1))));
}

TEST_F(HttpPortTest, WithTlsItSpeaksHttps) {
  start(with_tls(http_options()));
  EXPECT_THAT(daemon_->http_url(), StartsWith("https://127.0.0.1:"));
  const Visitor visitor{authority_.certificate(), {}, ""};
  EXPECT_THAT(list_with_tls(visitor), StartsWith("HTTP/1.1 200"));
  EXPECT_EQ(list_with_tls({other_authority_.certificate(), {}, ""}), "") << "The client does not trust it.";
  EXPECT_EQ(call("ListJobs", "application/json", "{}"), "") << "Plain text.";
  const std::string page = request("GET /", "");
  EXPECT_THAT(exchange_with_tls(port(), visitor, page, TLS1_2_VERSION), StartsWith("HTTP/1.1 200"));
  EXPECT_EQ(exchange_with_tls(port(), visitor, page, TLS1_1_VERSION), "");
  EXPECT_THAT(list_with_tls(visitor, "Origin: http://127.0.0.1:" + std::to_string(port()) + "\r\n"),
              StartsWith("HTTP/1.1 403"));
}

TEST_F(HttpPortTest, AHandshakeThatTakesTooLongIsBrokenOff) {
  DaemonOptions options = with_tls(http_options());
  options.connections.handshake = std::chrono::milliseconds(300);
  start(options);
  EXPECT_EQ(HttpSocket(port()).read_to_end(), "");
}

TEST_F(HttpPortTest, ChangedCertificatesAreForNewConnections) {
  const DaemonOptions options = with_tls(http_options());
  start(options);
  const Visitor old{authority_.certificate(), {}, ""};
  const Visitor newcomer{other_authority_.certificate(), {}, ""};
  ASSERT_THAT(list_with_tls(old), StartsWith("HTTP/1.1 200"));
  const std::string key = text_of_file(options.access.tls_key);
  static_cast<void>(other_authority_.sign("server", {"new-server"}));
  const std::string new_key = text_of_file(options.access.tls_key);
  write_secret(options.access.tls_key, key);
  daemon_->read_files_again();
  EXPECT_THAT(list_with_tls(old), StartsWith("HTTP/1.1 200")) << "A key of another certificate changes nothing.";
  write_secret(options.access.tls_key, new_key);
  daemon_->read_files_again();
  EXPECT_EQ(list_with_tls(old), "");
  EXPECT_THAT(list_with_tls(newcomer), StartsWith("HTTP/1.1 200"));
}

TEST_F(HttpPortTest, TheBodyOfACallIsReadOnceItsTokenWasChecked) {
  start(with_tokens(http_options()));
  const HttpSocket connection(port());
  connection.send("POST /cellcrush.v1.Jobs/GetJob HTTP/1.1\r\nHost: localhost:" + std::to_string(port()) +
                  "\r\nContent-Type: application/json\r\nContent-Length: 4000000\r\n\r\n");
  EXPECT_EQ(connection.read_some().substr(0, 12), "HTTP/1.1 401");
}

TEST_F(HttpPortTest, ClientCertificatesAreRequiredBesideTokens) {
  start(with_client_authority(with_tls(with_tokens(http_options()))));
  const auto status_of = [this](const CertificateFiles& shown, const std::string& headers) {
    return list_with_tls({authority_.certificate(), shown, ""}, headers).substr(0, 12);
  };
  const auto anna = authority_.sign("anna", client_request("anna"));
  EXPECT_EQ(status_of(anna, token_of("reader")), "HTTP/1.1 200");
  EXPECT_EQ(status_of(anna, ""), "HTTP/1.1 401");
  EXPECT_EQ(status_of({}, token_of("reader")), "");
  EXPECT_EQ(status_of(other_authority_.sign("eve", client_request("anna")), token_of("reader")), "");
  EXPECT_EQ(status_of(authority_.sign("plain", {"anna"}), token_of("reader")), "HTTP/1.1 401")
      << "It is not for clients.";
  CertificateRequest of_server{"anna"};
  of_server.extended_key_usage = "serverAuth";
  EXPECT_EQ(status_of(authority_.sign("other", of_server), token_of("reader")), "");
}

}  // namespace
}  // namespace cellcrush::testing
