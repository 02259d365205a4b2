// cellcrushd as a process: its addresses, its options, its signals and its log.
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

#include "access/token_file.h"
#include "error.h"
#include "net/listening_port.h"
#include "programs/certificates.h"
#include "programs/temporary_folder.h"
#include "server/daemon_fixture.h"
#include "server/daemon_process.h"
#include "server/http/http_socket.h"
#include "server/small_case.h"

namespace cellcrush::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class DaemonTest : public ::testing::Test {
 protected:
  [[nodiscard]] std::string data() const { return (folder_.path() / "data").string(); }
  [[nodiscard]] std::string socket() const { return "unix:" + (folder_.path() / "socket").string(); }

  TemporaryFolder folder_;
};

// gRPC itself would wait for two seconds: a client without a call does not read that its connection is to close.
TEST_F(DaemonTest, EndsAtOnceWithAnIdleClient) {
  DaemonProcess daemon({"--data", data(), "--listen", socket()});
  Client client(daemon.wait_for_addresses(1).at(0));
  EXPECT_TRUE(client.watch(client.create(small_case())).status.ok());
  daemon.send_signal(SIGTERM);
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(daemon.wait(), 0);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::milliseconds(1500));
}

TEST_F(DaemonTest, ServesASocketAndAPortAtOnceAndEndsInOrder) {
  DaemonProcess daemon({"--data", data(), "--listen", socket(), "--listen", "127.0.0.1:0"});
  const auto addresses = daemon.wait_for_addresses(2);
  ASSERT_EQ(addresses.size(), 2U);
  EXPECT_EQ(addresses[0], socket());
  EXPECT_THAT(addresses[1], StartsWith("127.0.0.1:"));
  EXPECT_NE(addresses[1], "127.0.0.1:0");
  const std::string job = Client(addresses[0]).create(small_case());
  EXPECT_TRUE(Client(addresses[1]).watch(job).status.ok());
  struct stat status {};
  ASSERT_EQ(stat(socket().substr(5).c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0600U);
  ASSERT_EQ(stat(data().c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0700U);
  daemon.send_signal(SIGTERM);
  EXPECT_EQ(daemon.wait(), 0) << daemon.errors();
}

// They would take 4 MB of every daemon and worker.
TEST_F(DaemonTest, LoadsNoLibraryThatOnlyReadsObjectStores) {
  DaemonProcess daemon({"--data", data(), "--listen", socket()});
  ASSERT_EQ(daemon.wait_for_addresses(1).size(), 1U);
  std::ifstream file("/proc/" + std::to_string(daemon.number()) + "/maps");
  const std::string maps(std::istreambuf_iterator<char>(file), {});
  ASSERT_THAT(maps, HasSubstr("libgrpc"));
  for (const char* library : {"libcurl", "libgnutls", "libkrb5", "libldap"}) {
    EXPECT_THAT(maps, Not(HasSubstr(library)));
  }
}

TEST_F(DaemonTest, EndsInOrderWhileAJobIsWatched) {
  DaemonProcess daemon({"--data", data(), "--listen", socket(), "--workers", "1"});
  ASSERT_EQ(daemon.wait_for_addresses(1).size(), 1U);
  Client client(socket());
  const std::string job = client.create(endless_case(), v1::Job::RUNNING);
  const std::string waiting = client.create(small_case());
  const auto context = bounded_context();
  const auto reader = client.jobs->WatchJob(context.get(), named<v1::WatchJobRequest>(waiting));
  v1::JobEvent event;
  ASSERT_TRUE(reader->Read(&event));
  daemon.send_signal(SIGINT);
  EXPECT_EQ(daemon.wait(), 0) << daemon.errors();
  while (reader->Read(&event)) {
  }
  EXPECT_EQ(reader->Finish().error_code(), grpc::StatusCode::UNAVAILABLE);
}

TEST_F(DaemonTest, ASecondDaemonOnTheSameFolderIsRefused) {
  DaemonProcess daemon({"--data", data(), "--listen", socket()});
  ASSERT_EQ(daemon.wait_for_addresses(1).size(), 1U);
  DaemonProcess second({"--data", data(), "--listen", "127.0.0.1:0"});
  EXPECT_TRUE(second.wait_for_addresses(1).empty());
  EXPECT_EQ(second.wait(), 1);
  EXPECT_THAT(second.errors(), HasSubstr("is in use by a running daemon"));
}

TEST_F(DaemonTest, APortOrASocketInUseIsRefused) {
  DaemonProcess daemon({"--data", data(), "--listen", socket(), "--listen", "127.0.0.1:0"});
  const auto addresses = daemon.wait_for_addresses(2);
  ASSERT_EQ(addresses.size(), 2U);
  for (const auto& address : addresses) {
    DaemonProcess second({"--data", (folder_.path() / "other").string(), "--listen", address});
    EXPECT_TRUE(second.wait_for_addresses(1).empty());
    EXPECT_EQ(second.wait(), 1);
    EXPECT_THAT(second.errors(), HasSubstr("Cannot listen on " + address));
  }
  EXPECT_FALSE(Client(addresses[0]).create(small_case()).empty()) << "The first one goes on.";
}

TEST_F(DaemonTest, ADefaultPortInUseIsANote) {
  // Or another program has it.
  std::unique_ptr<net::ListeningPort> other;
  try {
    other = std::make_unique<net::ListeningPort>(parse_listen_address("127.0.0.1:50551"));
  } catch (const ServiceError&) {
  }
  DaemonProcess daemon({"--data", data()});
  EXPECT_TRUE(daemon.wait_for_error("not listening on 127.0.0.1:50551"));
  EXPECT_FALSE(Client("unix:" + data() + "/cellcrushd.sock").create(small_case()).empty());
}

TEST_F(DaemonTest, AHangupReadsTheTokensAgainAndNeverEndsTheDaemon) {
  const auto made = access::make_token("anna", access::Scope::read);
  write_secret(folder_.path() / "tokens", made.line + "\n");
  for (const bool has_tokens : {true, false}) {
    std::vector<std::string> arguments = {"--data", data(), "--listen", socket()};
    if (has_tokens) arguments.insert(arguments.end(), {"--tokens", (folder_.path() / "tokens").string()});
    DaemonProcess daemon(arguments);
    ASSERT_EQ(daemon.wait_for_addresses(1).size(), 1U);
    daemon.send_signal(SIGHUP);
    EXPECT_TRUE(daemon.wait_for_error(has_tokens ? "tokens reloaded: 1 of --tokens" : "nothing to reload"));
    daemon.send_signal(SIGTERM);
    EXPECT_EQ(daemon.wait(), 0) << daemon.errors();
  }
}

TEST_F(DaemonTest, AKeyOfTheConfigFileThatIsNoOptionIsRefusedWithTheNearest) {
  const auto start_with = [&](const std::string& text) {
    write_secret(folder_.path() / "config.toml", text);
    DaemonProcess daemon(
        {"--data", data(), "--listen", socket(), "--config", (folder_.path() / "config.toml").string()});
    const bool serves = daemon.wait_for_addresses(1).size() == 1;
    if (serves) daemon.send_signal(SIGTERM);
    EXPECT_EQ(daemon.wait(), serves ? 0 : 2);
    return serves ? "" : daemon.errors();
  };
  EXPECT_EQ(start_with("workers = 1\nmin-free-disk = 0\n"), "");
  EXPECT_THAT(start_with("min-fre-disk = 0\n"), HasSubstr("Did you mean \"min-free-disk\"?"));
  EXPECT_THAT(start_with("colour = \"red\"\n"), HasSubstr("\"colour\", which is not an option"));
}

TEST_F(DaemonTest, AnOptionThatIsUnknownOrHasABadValueIsRefusedWithTheRemedy) {
  const auto errors_of = [](const std::vector<std::string>& arguments) {
    DaemonProcess daemon(arguments);
    EXPECT_EQ(daemon.wait(), 2);
    return daemon.errors();
  };
  EXPECT_THAT(errors_of({"--wokers", "3"}),
              HasSubstr("cellcrushd: unknown option \"--wokers\"; did you mean \"--workers\"?"));
  EXPECT_THAT(errors_of({"token", "anna", "--scope", "read", "--scopes=admin"}),
              HasSubstr("did you mean \"--scope\"?"));
  EXPECT_THAT(errors_of({"--colour=red"}), HasSubstr("unknown option \"--colour\"\nSee `cellcrushd --help`"));
  for (const char* origin : {"https://a.example/grafana", "a.example", "https://", "*", "https://A.example; img-src *"})
    EXPECT_THAT(errors_of({"--allow-framing", origin}), HasSubstr("is not an origin. Write it as https://HOST"));
}

constexpr const char* kForgery = "x\n[2030-01-01 00:00:00.000] [cellcrushd] [info] jobs/9 deleted by root";

// A frame of HTTP/2 (RFC 9113, 4.1).
std::string http2_frame(char type, char flags, char stream, const std::string& payload) {
  const auto size = static_cast<unsigned>(payload.size());
  std::string out{static_cast<char>(size >> 16U), static_cast<char>(size >> 8U), static_cast<char>(size), type, flags};
  return out + std::string(3, '\0') + stream + payload;
}

// A header without compression (RFC 7541, 6.2.2).
std::string http2_header(const std::string& name, const std::string& value) {
  return std::string(1, '\0') + static_cast<char>(name.size()) + name + static_cast<char>(value.size()) + value;
}

// A call without a message, and one header of it forged.
std::string forged_call(const std::string& header) {
  constexpr char kSettings = 4;
  constexpr char kHeaders = 1;
  constexpr char kEndOfAll = 5;
  std::string headers;
  for (const auto& [name, value] : {std::pair(":method", "POST"), std::pair(":scheme", "http"),
                                    std::pair(":path", "/cellcrush.v1.Jobs/ListJobs"), std::pair(":authority", "x")})
    headers += http2_header(name, value);
  headers += http2_header(header, kForgery);
  return "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n" + http2_frame(kSettings, 0, 0, "") +
         http2_frame(kHeaders, kEndOfAll, 1, headers);
}

// The daemon's line about it, with the line break of the forgery escaped.
std::string logged_of(const std::string& header) {
  return "[error] gRPC: Error parsing metadata: error=invalid value key=" + header + " value=x\\x0a[2030-01-01";
}

// Sends a call whose header is forged, and keeps the connection until the daemon has logged that.
void send_forged_call(DaemonProcess& daemon, const std::string& address, const std::string& header) {
  const HttpSocket connection(std::stoi(address.substr(address.rfind(':') + 1)));
  connection.send(forged_call(header));
  EXPECT_TRUE(daemon.wait_for_error(logged_of(header))) << daemon.errors();
}

TEST(ForgedLog, AHeaderWithALineInItIsPartOfOneLine) {
  const TemporaryFolder folder;
  DaemonProcess daemon({"--data", (folder.path() / "data").string(), "--listen", "127.0.0.1:0"});
  const auto addresses = daemon.wait_for_addresses(1);
  ASSERT_EQ(addresses.size(), 1U);
  for (const char* header : {"te", "grpc-timeout"}) send_forged_call(daemon, addresses.front(), header);
  daemon.send_signal(SIGTERM);
  EXPECT_EQ(daemon.wait(), 0);
  std::istringstream lines(daemon.errors());
  for (std::string line; std::getline(lines, line);) {
    EXPECT_THAT(line, StartsWith("[20"));
    EXPECT_THAT(line, ::testing::Not(StartsWith("[2030")));
  }
}

}  // namespace
}  // namespace cellcrush::testing
