#include "net/acceptor.h"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <mutex>
#include <thread>

#include "error.h"
#include "net/port_probe.h"
#include "server/temporary_folder.h"

namespace cellcrush::testing {
namespace {

using net::Acceptor;
using net::ConnectionLimits;
using net::ConnectionTable;
using net::ListeningPort;
using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::HasSubstr;

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
  auto now = ConnectionTable::Clock::now();
  ConnectionTable table({3, 2}, [&now] { return now; });
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
  now += seconds(1);
  EXPECT_EQ(table.admit(four.ends[0], "b"), std::nullopt);
  EXPECT_EQ(table.count(), 3U);
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
}

class AcceptorTest : public ::testing::Test {
 protected:
  // An acceptor on a port and a socket, which keeps what it is given.
  void start(ConnectionLimits limits, bool accepts = true) {
    std::vector<ListeningPort> ports;
    ports.emplace_back(parse_listen_address("127.0.0.1:0"));
    ports.emplace_back(parse_listen_address("unix:" + (folder_.path() / "socket").string()));
    Acceptor::Parts parts;
    parts.hand_over = [this](std::size_t port, int, int descriptor) {
      const std::scoped_lock lock(mutex_);
      taken_.emplace_back(port, descriptor);
      // As gRPC: a server of HTTP/2 begins to talk.
      (void)send(descriptor, "settings", 8, MSG_NOSIGNAL);
    };
    parts.turn_away = [](std::size_t, int, int descriptor) {
      (void)send(descriptor, "no", 2, MSG_NOSIGNAL);
      close(descriptor);
    };
    parts.refused = [this](const std::string& why) {
      const std::scoped_lock lock(mutex_);
      refused_.push_back(why);
    };
    parts.counted = [](std::size_t) {};
    acceptor_.emplace(std::move(ports), limits, std::move(parts));
    if (accepts) acceptor_->start();
  }

  void TearDown() override {
    acceptor_.reset();
    for (const auto& [port, descriptor] : taken_) close(descriptor);
    for (const int connection : connections_) close(connection);
  }

  int connect() {
    const int out = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    connections_.push_back(out);
    sockaddr_in name{};
    name.sin_family = AF_INET;
    name.sin_port = htons(static_cast<std::uint16_t>(acceptor_->addresses().front().port));
    name.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::connect(out, reinterpret_cast<const sockaddr*>(&name), sizeof(name)), 0);
    return out;
  }

  // What comes until the other side ends, or for a moment.
  static std::string read_all(int connection) {
    std::string out;
    char buffer[1024];
    pollfd waiting{connection, POLLIN, 0};
    while (poll(&waiting, 1, 5000) > 0) {
      const auto count = recv(connection, buffer, sizeof(buffer), 0);
      if (count <= 0) break;
      out.append(buffer, static_cast<std::size_t>(count));
      if (out == "settings") break;
    }
    return out;
  }

  TemporaryFolder folder_;
  std::mutex mutex_;
  std::vector<std::pair<std::size_t, int>> taken_;
  std::vector<std::string> refused_;
  std::vector<int> connections_;
  std::optional<Acceptor> acceptor_;
};

TEST_F(AcceptorTest, RefusesWithWordsWhatIsBeyondTheLimitAndServesAgainLater) {
  ConnectionLimits limits;
  limits.connections = 2;
  start(limits);
  EXPECT_EQ(read_all(connect()), "settings");
  EXPECT_EQ(read_all(connect()), "settings");
  EXPECT_EQ(read_all(connect()), "no");
  {
    const std::scoped_lock lock(mutex_);
    ASSERT_EQ(refused_.size(), 1U);
    EXPECT_THAT(refused_.front(), HasSubstr("from 127.0.0.1: 2 connections are open, the limit of --max-connections"));
    close(taken_.back().second);
    taken_.pop_back();
  }
  std::string answer;
  for (int i = 0; i < 50 && answer != "settings"; ++i) {
    std::this_thread::sleep_for(milliseconds(20));
    answer = read_all(connect());
  }
  EXPECT_EQ(answer, "settings");
}

TEST_F(AcceptorTest, StrangersOnTcpDoNotShutOutTheUnixSocket) {
  ConnectionLimits limits;
  limits.connections = 1;
  start(limits);
  EXPECT_EQ(read_all(connect()), "settings");
  EXPECT_EQ(read_all(connect()), "no");
  EXPECT_TRUE(net::answers(acceptor_->addresses().back(), "", seconds(5)));
  const std::scoped_lock lock(mutex_);
  EXPECT_EQ(taken_.back().first, 1U);
}

TEST_F(AcceptorTest, AProbeFindsAPortThatNobodyAcceptsOn) {
  start({}, false);
  for (const auto& address : acceptor_->addresses()) EXPECT_FALSE(net::answers(address, "", milliseconds(100)));
  acceptor_->start();
  for (const auto& address : acceptor_->addresses()) EXPECT_TRUE(net::answers(address, "", seconds(5)));
}

TEST_F(AcceptorTest, APortWhoseSocketWasRemovedIsOpenedAgainByTheProbe) {
  ConnectionLimits limits;
  limits.probe_interval = milliseconds(20);
  start(limits);
  const net::PortProbe probe(*acceptor_, {true, true}, limits);
  const auto path = folder_.path() / "socket";
  ASSERT_TRUE(std::filesystem::remove(path));
  for (int i = 0; i < 250 && !std::filesystem::exists(path); ++i) std::this_thread::sleep_for(milliseconds(20));
  EXPECT_TRUE(net::answers(acceptor_->addresses().back(), "", seconds(5)));
}

TEST_F(AcceptorTest, AnAddressThatIsTakenIsRefusedByName) {
  start({});
  const auto taken = acceptor_->addresses().front();
  try {
    const ListeningPort second(taken);
    FAIL() << "two listen on " << taken.text();
  } catch (const ServiceError& refused) {
    EXPECT_EQ(refused.kind(), ServiceError::Kind::failed_precondition);
    EXPECT_THAT(refused.what(), HasSubstr("Cannot listen on " + taken.text()));
  }
}

TEST(ClientHello, IsAHandshakeRecordOfTls) {
  const std::string hello = net::client_hello();
  ASSERT_GT(hello.size(), 100U);
  EXPECT_EQ(hello[0], 0x16);
  EXPECT_EQ(hello[1], 0x03);
}

}  // namespace
}  // namespace cellcrush::testing
