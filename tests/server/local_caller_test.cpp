// Who calls on this machine: the kernel says it, on Unix sockets and on loopback.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <grpcpp/create_channel_posix.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <functional>
#include <thread>

#include "access/unix_user.h"
#include "net/listening_port.h"
#include "server/daemon_process.h"
#include "server/http/http_fixture.h"

namespace cellcrush::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

constexpr uid_t kNobody = 65534;  // a member of the group nogroup
constexpr uid_t kDaemon = 1;      // in a group of its own

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
  EXPECT_THAT(list_as(kNobody, "Cookie: other=1; " + cookie + "\r\n"), StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(list_as(kNobody, "Cookie: " + cookie + "0\r\n"), StartsWith("HTTP/1.1 401"));
  daemon_->read_files_again();
  EXPECT_THAT(list_as(kNobody, "Cookie: " + cookie + "\r\n"), StartsWith("HTTP/1.1 401")) << "It has ended.";
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
