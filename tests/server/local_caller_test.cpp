// Who calls on this machine: the kernel says it, on Unix sockets and on loopback.
#include <dlfcn.h>
#include <fcntl.h>
#include <gmock/gmock.h>
#include <grp.h>
#include <grpcpp/create_channel_posix.h>
#include <netinet/in.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <functional>
#include <optional>
#include <thread>

#include "access/sessions.h"
#include "access/unix_user.h"
#include "net/listening_port.h"
#include "open_file.h"
#include "server/daemon_process.h"
#include "server/held_point.h"
#include "server/http/http_fixture.h"

namespace cellcrush::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

constexpr uid_t kNobody = 65534;  // a member of the group nogroup
constexpr uid_t kDaemon = 1;      // in a group of its own

std::atomic<HeldPoint*> slow_lookup = nullptr;  // of the groups of a user; null: none is slow

// Does something as another user, in a thread: to the kernel each thread has a user.
void as_user(uid_t user, const std::function<void()>& action) {
  std::jthread([&] {
    ASSERT_EQ(syscall(SYS_setresuid, -1, user, -1), 0);
    action();
  }).join();
}

class LocalCallerTest : public HttpFixture {
 protected:
  void SetUp() override {
    if (geteuid() != 0) GTEST_SKIP() << "Only root can act as another user.";
    HttpFixture::SetUp();
    std::filesystem::permissions(folder_.path(), std::filesystem::perms(0011), std::filesystem::perm_options::add);
  }

  // A client whose connection this user has opened.
  [[nodiscard]] static Client client_as(uid_t user, const std::string& address) {
    int connection = -1;
    as_user(user, [&] {
      const auto name = net::name_of(parse_listen_address(address));
      connection = socket(name.address.ss_family, SOCK_STREAM | SOCK_CLOEXEC, 0);
      EXPECT_EQ(connect(connection, reinterpret_cast<const sockaddr*>(&name.address), name.size), 0);
    });
    fcntl(connection, F_SETFL, O_NONBLOCK);
    return Client(grpc::CreateInsecureChannelFromFd("local", connection));
  }

  // The answer to a call over HTTP on a connection that this user has opened.
  [[nodiscard]] std::string list_as(uid_t user, const std::string& headers = "") const {
    std::string out;
    as_user(user, [&] { out = call("ListJobs", "application/json", "{}", headers); });
    return out;
  }

  [[nodiscard]] static v1::WhoAmIResponse who_am_i(const Client& client) {
    return answer_of(*v1::Admin::NewStub(client.channel), &v1::Admin::Stub::WhoAmI, {});
  }

  [[nodiscard]] static std::string link_of(const Client& client) {
    v1::CreateLinkRequest request;
    request.set_page("jobs/1");
    return answer_of(*v1::Admin::NewStub(client.channel), &v1::Admin::Stub::CreateLink, request).url();
  }
};

TEST_F(LocalCallerTest, AMemberOfAGroupOwnsWhatItMakesOnTheSocketAndChangesNothingElse) {
  auto options = default_options();
  options.access.groups = {{"nogroup", access::Scope::submit}};
  start(options);
  const std::string address = daemon_->addresses().front();
  auto own = client();
  const std::string of_own = own.create(small_case(), v1::Job::SUCCEEDED);
  EXPECT_EQ(own.get(of_own).owner(), access::own_user());
  EXPECT_EQ(who_am_i(own).scope(), "admin");
  auto nobody = client_as(kNobody, address);
  EXPECT_EQ(who_am_i(nobody).name(), "nobody");
  EXPECT_EQ(who_am_i(nobody).scope(), "submit");
  EXPECT_EQ(who_am_i(nobody).server_owner(), access::own_user());
  EXPECT_EQ(nobody.get(nobody.create(small_case())).owner(), "nobody");
  EXPECT_THAT(nobody.remove(of_own), Fails(grpc::StatusCode::PERMISSION_DENIED, "belongs to " + access::own_user()));
  EXPECT_THAT(try_call(*v1::Admin::NewStub(nobody.channel), &v1::Admin::Stub::Drain, {}),
              Fails(grpc::StatusCode::PERMISSION_DENIED, "nobody has scope submit"));
  EXPECT_THAT(client_as(kDaemon, address).try_to(v1::ListJobsRequest()),
              Fails(grpc::StatusCode::UNAUTHENTICATED, "--group-scope"));
  options.access.groups = {{"no-such-group", access::Scope::read}};
  EXPECT_THAT(refusal_of_start(options), HasSubstr("--group-scope no-such-group=read: there is no Unix group"));
}

TEST_F(LocalCallerTest, LoopbackTakesOnlyTheDaemonsOwnUserWithoutAToken) {
  auto options = http_options();
  options.listen.push_back("127.0.0.1:0");
  start(options);
  const std::string port_of_grpc = daemon_->addresses().back();
  EXPECT_EQ(who_am_i(Client(port_of_grpc)).name(), access::own_user());
  EXPECT_THAT(client_as(kNobody, port_of_grpc).try_to(v1::ListJobsRequest()),
              Fails(grpc::StatusCode::UNAUTHENTICATED, "This server belongs to " + access::own_user()));
  EXPECT_THAT(list_as(0), StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(list_as(kNobody), AllOf(StartsWith("HTTP/1.1 401"), HasSubstr("cellcrush open")));
}

TEST_F(LocalCallerTest, ALinkLetsABrowserInOnceAndForItsCallerOnly) {
  auto options = with_tokens(http_options());
  start(options);
  const std::string url = link_of(client());
  EXPECT_THAT(url, StartsWith(daemon_->http_url() + "/sign-in?"));
  const std::string get = request("GET " + url.substr(daemon_->http_url().size()), "");
  EXPECT_THAT(exchange(request("HEAD " + url.substr(daemon_->http_url().size()), "")), Not(HasSubstr("Set-Cookie")));
  const std::string answer = exchange(get);
  EXPECT_THAT(answer, AllOf(StartsWith("HTTP/1.1 303"), HasSubstr("Location: ./jobs/1\r\n"), HasSubstr("; HttpOnly;"),
                            HasSubstr("; SameSite=Strict;")));
  EXPECT_THAT(exchange(get), AllOf(StartsWith("HTTP/1.1 403"), HasSubstr("used before")));
  const auto begin = answer.find("cellcrush-", answer.find("Set-Cookie: "));
  const std::string cookie = answer.substr(begin, answer.find(';', begin) - begin);
  EXPECT_THAT(list_as(0, "Cookie: other=1; " + cookie + "\r\n"), StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(list_as(0, "Authorization: Basic b2Y6cHJveHk=\r\nCookie: " + cookie + "\r\n"),
              StartsWith("HTTP/1.1 200"))
      << "The password of a proxy is no token.";
  EXPECT_THAT(list_as(0, "Authorization: Bearer no\r\nCookie: " + cookie + "\r\n"), StartsWith("HTTP/1.1 401"));
  EXPECT_THAT(list_as(0, "Cookie: " + cookie + "0\r\n"), StartsWith("HTTP/1.1 401"));
  EXPECT_THAT(list_as(kNobody, "Cookie: " + cookie + "\r\n"), StartsWith("HTTP/1.1 401"))
      << "A browser shows it to servers of other users on this machine.";
  daemon_->read_files_again();
  EXPECT_THAT(list_as(0, "Cookie: " + cookie + "\r\n"), StartsWith("HTTP/1.1 401")) << "It has ended.";
}

TEST_F(LocalCallerTest, ASlowUserDatabaseHoldsUpOnlyThoseForWhomItIsAsked) {
  auto options = default_options();
  options.access.groups = {{"nogroup", access::Scope::read}};
  start(options);
  HeldPoint point;
  slow_lookup = &point;
  auto nobody = client_as(kNobody, daemon_->addresses().front());
  EXPECT_TRUE(point.wait());
  slow_lookup = nullptr;
  EXPECT_EQ(who_am_i(client()).scope(), "admin");
  point.open();
  EXPECT_EQ(who_am_i(nobody).scope(), "read");
}

// The two ends of a connection that this process has with itself.
struct Pair {
  explicit Pair(const std::string& host, int family) {
    const net::ListeningPort port(parse_listen_address(host + ":0"), "--listen");
    auto name = net::name_of(port.address());
    if (family == AF_INET6 && name.address.ss_family == AF_INET) {
      const auto address = reinterpret_cast<const sockaddr_in&>(name.address);
      auto& mapped = reinterpret_cast<sockaddr_in6&>(name.address) = {};
      mapped.sin6_family = AF_INET6;
      mapped.sin6_port = address.sin_port;
      mapped.sin6_addr.s6_addr32[2] = htonl(0xffff);
      mapped.sin6_addr.s6_addr32[3] = address.sin_addr.s_addr;
      name.size = sizeof(mapped);
    }
    other = OpenFile(socket(family, SOCK_STREAM | SOCK_CLOEXEC, 0));
    EXPECT_EQ(connect(other.get(), reinterpret_cast<const sockaddr*>(&name.address), name.size), 0);
    own = OpenFile(accept(port.descriptors().front(), nullptr, nullptr));
  }

  [[nodiscard]] std::optional<uid_t> user() const {
    sockaddr_storage here{};
    sockaddr_storage there{};
    socklen_t size = sizeof(here);
    getsockname(own.get(), reinterpret_cast<sockaddr*>(&here), &size);
    size = sizeof(there);
    getpeername(own.get(), reinterpret_cast<sockaddr*>(&there), &size);
    return access::user_in_socket_tables(here, there);
  }

  OpenFile other;
  OpenFile own;
};

TEST_F(LocalCallerTest, TheTablesOfSocketsSayWhoCallsWhereTheKernelHasNoOtherWay) {
  std::optional<Pair> pair;
  for (const auto& [host, family] : {std::pair("127.0.0.1", AF_INET), {"127.0.0.1", AF_INET6}, {"[::1]", AF_INET6}}) {
    as_user(kDaemon, [&pair, host = host, family = family] { pair.emplace(host, family); });
    EXPECT_EQ(pair->user(), kDaemon) << host;
    EXPECT_EQ(access::user_of_peer(pair->own.get()), kDaemon) << host;
  }
  static_cast<void>(pair->other.close());
  EXPECT_EQ(pair->user(), std::nullopt) << "closed";
}

// Nobody pushes out the sessions of others.
TEST(SessionsTest, ACallerHasAHundredSessionsAndTheOldestGivesWay) {
  std::chrono::system_clock::time_point now{};
  access::Sessions sessions([&now] { return now += std::chrono::milliseconds(1); });
  sessions.serve_at("http://127.0.0.1:1");
  const auto open = [&sessions](const std::string& name) {
    const std::string link = sessions.make_link({name, access::Scope::read}, "").url;
    return sessions.redeem(link.substr(link.find("code=") + 5), 7).value_or("");
  };
  const std::string of_bob = open("bob");
  const std::string first = open("anna");
  const std::string second = open("anna");
  for (int i = 0; i < 99; ++i) open("anna");
  EXPECT_FALSE(sessions.find(first, 7));
  EXPECT_TRUE(sessions.find(second, 7));
  EXPECT_FALSE(sessions.find(second, 8));
  EXPECT_FALSE(sessions.find(second, std::nullopt));
  EXPECT_TRUE(sessions.find(of_bob, 7));
}

TEST_F(LocalCallerTest, StreamsWithoutATokenCountForTheUserWhomTheKernelKnowsOrElseForTheAddress) {
  DaemonOptions options = with_tokens(http_options());
  options.connections.streams_per_caller = 1;
  start(options);
  // The first words of a watch of health.
  const auto watch = [this](const HttpSocket& socket) {
    const char* type = "Content-Type: application/connect+json\r\n";
    socket.send(request("POST /grpc.health.v1.Health/Watch", type, envelope("{}")));
    std::string out;
    for (std::string more = "."; !more.empty() && out.find('{') == std::string::npos; out += more)
      more = socket.read_some();
    return out;
  };
  const HttpSocket own(port());
  EXPECT_THAT(watch(own), HasSubstr("SERVING"));
  const HttpSocket second(port());
  EXPECT_THAT(watch(second), HasSubstr(access::own_user() + " has 1 streams open"));
  as_user(kDaemon, [&] {
    const HttpSocket other(port());
    EXPECT_THAT(watch(other), HasSubstr("SERVING"));
    const HttpSocket more(port());
    EXPECT_THAT(watch(more), HasSubstr("127.0.0.1 has 1 streams open"));
    const HttpSocket elsewhere(port(), 0, "127.0.0.2");
    EXPECT_THAT(watch(elsewhere), HasSubstr("SERVING"));
  });
}

}  // namespace
}  // namespace cellcrush::testing

extern "C" int getgrouplist(const char* user, gid_t group, gid_t* groups, int* count) {
  if (auto* point = cellcrush::testing::slow_lookup.load()) point->stand();
  static const auto real = reinterpret_cast<decltype(&getgrouplist)>(dlsym(RTLD_NEXT, "getgrouplist"));
  return real(user, group, groups, count);
}
