// A caller cannot write lines of his own into the log: gRPC logs the bytes of headers that it cannot read.
#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <sys/socket.h>
#include <unistd.h>

#include <csignal>
#include <sstream>
#include <string>

#include "server/daemon_process.h"
#include "server/temporary_folder.h"

namespace cellcrush::testing {
namespace {

using ::testing::StartsWith;

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
  const std::string bytes = forged_call(header);
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_port = htons(static_cast<std::uint16_t>(std::stoi(address.substr(address.rfind(':') + 1))));
  place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const int connection = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  EXPECT_EQ(connect(connection, reinterpret_cast<const sockaddr*>(&place), sizeof(place)), 0);
  EXPECT_EQ(write(connection, bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
  EXPECT_TRUE(daemon.wait_for_error(logged_of(header))) << daemon.errors();
  close(connection);
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
