// Where the daemon listens, and how many connections it admits.
#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <fstream>

#include "error.h"
#include "listen_address.h"
#include "net/acceptor.h"
#include "net/port_probe.h"
#include "programs/temporary_folder.h"
#include "server/daemon_process.h"

namespace cellcrush::testing {
namespace {

using net::ConnectionTable;
using ::testing::HasSubstr;

TEST(ListenAddress, TakesSocketsAndLoopbackPorts) {
  EXPECT_EQ(parse_listen_address("unix:/tmp/a.sock").text(), "unix:/tmp/a.sock");
  EXPECT_EQ(parse_listen_address("127.0.0.1:50551").text(), "127.0.0.1:50551");
  EXPECT_EQ(parse_listen_address("localhost:0").port, 0);
  EXPECT_EQ(parse_listen_address("[::1]:7").text(), "[::1]:7");
  for (const char* text : {"unix:/tmp/a.sock", "127.0.0.1:1", "127.3.2.1:1", "localhost:1", "[::1]:1", "[0:0::1]:1"})
    EXPECT_TRUE(parse_listen_address(text).is_loopback()) << text;
}

TEST(ListenAddress, KnowsWhatOthersCanReach) {
  for (const char* text :
       {"0.0.0.0:1", "192.168.1.4:1", "[::]:1", "[::ffff:127.0.0.1]:1", "[2001:db8::1]:1", "128.0.0.1:1"})
    EXPECT_FALSE(parse_listen_address(text).is_loopback()) << text;
}

TEST(ListenAddress, RefusesWhatIsNoAddress) {
  for (const char* text : {"example.org:1", "unix-abstract:a:1", "::1:1", "[127.0.0.1]:1", "0x7f.1:1", ":50551",
                           "127.0.0.1", "127.0.0.1:", "127.0.0.1:70000", "127.0.0.1:-1", "127.0.0.1:12x", "unix:", ""})
    EXPECT_THROW(parse_listen_address(text), ServiceError) << text;
  EXPECT_THROW(parse_listen_address("unix:/tmp/" + std::string(120, 'x')), ServiceError);
}

TEST(ListenAddress, AFileThatIsNoSocketIsLeftAlone) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "file";
  std::ofstream(path) << "precious";
  EXPECT_THROW(net::remove_stale_socket(path.string()), ServiceError);
  EXPECT_TRUE(std::filesystem::exists(path));
  EXPECT_NO_THROW(net::remove_stale_socket((folder.path() / "absent").string()));
}

// A pair of connected sockets; the second is the peer's.
struct SocketPair {
  SocketPair() { EXPECT_EQ(socketpair(AF_UNIX, SOCK_STREAM, 0, ends), 0); }
  ~SocketPair() {
    close_first();
    close(ends[1]);
  }
  SocketPair(const SocketPair&) = delete;
  SocketPair& operator=(const SocketPair&) = delete;
  void close_first() {
    if (ends[0] >= 0) close(ends[0]);
    ends[0] = -1;
  }
  int ends[2] = {-1, -1};
};

TEST(ConnectionTable, AdmitsUpToBothLimitsAndForgetsWhatWasClosed) {
  ConnectionTable table({3, 2});
  SocketPair one;
  SocketPair two;
  SocketPair three;
  SocketPair four;
  EXPECT_EQ(table.admit(one.ends[0], "a"), std::nullopt);
  EXPECT_EQ(table.admit(two.ends[0], "a"), std::nullopt);
  EXPECT_THAT(table.admit(three.ends[0], "a").value(), HasSubstr("a has 2 connections open"));
  EXPECT_EQ(table.admit(three.ends[0], "b"), std::nullopt);
  EXPECT_THAT(table.admit(four.ends[0], "b").value(), HasSubstr("3 connections are open"));
  one.close_first();
  EXPECT_TRUE(wait_until([&] { return !table.admit(four.ends[0], "b"); }));
  EXPECT_EQ(table.count(), 3U);
}

TEST(ConnectionTable, ClosesTheOldestStrangerForANewConnectionButNotThoseWithAnAdmittedCall) {
  ConnectionTable table({4, 4});
  std::array<SocketPair, 6> pairs;
  for (std::size_t i = 0; i < 4; ++i)
    ASSERT_EQ(table.admit(pairs[i].ends[0], "a", "ipv4:a:" + std::to_string(i)), std::nullopt);
  table.know("ipv4:a:0", "anna");
  table.know(pairs[2].ends[0], "anna");
  table.know(pairs[3].ends[0], "anna");  // more than half of the places
  const auto is_closed = [&](std::size_t i) {
    char byte = 0;
    return recv(pairs[i].ends[1], &byte, 1, MSG_DONTWAIT) == 0;
  };
  EXPECT_EQ(table.admit(pairs[4].ends[0], "a", "ipv4:a:4"), std::nullopt);
  EXPECT_TRUE(is_closed(1));
  table.know(pairs[4].ends[0], "ben");
  EXPECT_EQ(table.admit(pairs[5].ends[0], "a", "ipv4:a:5"), std::nullopt);
  EXPECT_TRUE(is_closed(3));
  for (const std::size_t i : {0, 2, 4}) EXPECT_FALSE(is_closed(i)) << i;
}

TEST(ConnectionTable, TellsADescriptorThatIsUsedAgainFromTheConnectionThatHadIt) {
  ConnectionTable table({2, 2});
  SocketPair first;
  const int number = first.ends[0];
  ASSERT_EQ(table.admit(number, "a"), std::nullopt);
  SocketPair second;
  ASSERT_EQ(dup2(second.ends[0], number), number);
  table.drop_closed();
  EXPECT_EQ(table.count(), 0U);
  EXPECT_EQ(table.admit(number, "b"), std::nullopt);
  EXPECT_EQ(table.count(), 1U);
}

TEST(ConnectionTable, CutsAConnectionWithAllThatItHasSent) {
  const net::ListeningPort port({ListenAddress::Kind::tcp, "127.0.0.1", 0}, "--listen");
  const auto name = net::name_of(port.address());
  const int client = socket(AF_INET, SOCK_STREAM, 0);
  ASSERT_EQ(connect(client, reinterpret_cast<const sockaddr*>(&name.address), name.size), 0);
  ASSERT_EQ(write(client, "much", 4), 4);
  const int end = accept(port.descriptors().front(), nullptr, nullptr);
  ConnectionTable table({1, 1});
  ASSERT_EQ(table.admit(end, "a", "ipv4:a:1"), std::nullopt);
  EXPECT_FALSE(table.cut("ipv4:a:2"));
  EXPECT_TRUE(table.cut("ipv4:a:1"));
  char byte = 0;
  EXPECT_LT(recv(end, &byte, 1, MSG_DONTWAIT), 0) << "nothing of it is left to read";
  EXPECT_LE(recv(client, &byte, 1, 0), 0);
  close(client);
  close(end);
}

TEST(PeerOf, IsTheAddressOfIpv4AndTheNetworkOfIpv6) {
  const auto ipv6 = [](const char* text) {
    sockaddr_storage out{};
    auto& name = reinterpret_cast<sockaddr_in6&>(out);
    name.sin6_family = AF_INET6;
    inet_pton(AF_INET6, text, &name.sin6_addr);
    return out;
  };
  EXPECT_EQ(net::peer_of(ipv6("2001:db8:1:2:3:4:5:6")), "2001:db8:1:2::/64");
  EXPECT_EQ(net::peer_of(ipv6("::ffff:192.0.2.7")), "192.0.2.7");
  EXPECT_EQ(net::peer_of(ipv6("::1")), "::1");
  EXPECT_EQ(net::peer_of({}), "unix");
  for (const char* address : {"2001:db8:1:2:3:4:5:6", "::ffff:192.0.2.7", "::1"})
    EXPECT_EQ(net::peer_of_name(net::name_of(ipv6(address))), net::peer_of(ipv6(address)));
  EXPECT_EQ(net::peer_of_name("unix:/run/cellcrushd.sock"), "unix");
}

}  // namespace
}  // namespace cellcrush::testing
