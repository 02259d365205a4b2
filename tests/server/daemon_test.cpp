#include <gmock/gmock.h>
#include <sys/stat.h>

#include <csignal>
#include <filesystem>

#include "server/daemon_fixture.h"
#include "server/daemon_process.h"
#include "server/raw_call.h"
#include "server/small_case.h"

namespace cellcrush::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class DaemonTest : public ::testing::Test {
 protected:
  [[nodiscard]] std::string data() const { return (folder_.path() / "data").string(); }
  [[nodiscard]] std::string socket() const { return "unix:" + (folder_.path() / "socket").string(); }

  TemporaryFolder folder_;
};

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

TEST_F(DaemonTest, EndsInOrderWhileAJobIsWatched) {
  DaemonProcess daemon({"--data", data(), "--listen", socket(), "--workers", "1"});
  ASSERT_EQ(daemon.wait_for_addresses(1).size(), 1U);
  Client client(socket());
  const std::string job = client.create(endless_case());
  ASSERT_TRUE(client.wait_for_state(job, v1::Job::RUNNING));
  const std::string waiting = client.create(small_case());
  v1::WatchJobRequest request;
  request.set_name(waiting);
  const auto context = bounded_context();
  const auto reader = client.jobs->WatchJob(context.get(), request);
  v1::JobEvent event;
  ASSERT_TRUE(reader->Read(&event));
  daemon.send_signal(SIGINT);
  EXPECT_EQ(daemon.wait(), 0) << daemon.errors();
  while (reader->Read(&event)) {
  }
  EXPECT_EQ(reader->Finish().error_code(), grpc::StatusCode::UNAVAILABLE);
}

TEST_F(DaemonTest, KilledItLosesNothingAndTheNextOneGoesOn) {
  std::string running;
  std::string waiting;
  std::string done;
  {
    DaemonProcess daemon({"--data", data(), "--listen", socket(), "--workers", "1"});
    ASSERT_EQ(daemon.wait_for_addresses(1).size(), 1U);
    Client client(socket());
    done = client.create(small_case());
    ASSERT_TRUE(client.wait_for_state(done, v1::Job::SUCCEEDED));
    running = client.create(endless_case());
    ASSERT_TRUE(client.wait_for_state(running, v1::Job::RUNNING));
    waiting = client.create(small_case());
    daemon.send_signal(SIGKILL);
    EXPECT_EQ(daemon.wait(), -1 - SIGKILL);
  }
  DaemonProcess daemon({"--data", data(), "--listen", socket(), "--workers", "1"});
  ASSERT_EQ(daemon.wait_for_addresses(1).size(), 1U) << "The stale socket is replaced.";
  Client client(socket());
  EXPECT_EQ(client.get(running).state(), v1::Job::RUNNING);
  EXPECT_EQ(client.get(waiting).state(), v1::Job::PENDING);
  ASSERT_TRUE(client.cancel(running).ok());
  EXPECT_TRUE(client.watch(waiting).status.ok());
  EXPECT_EQ(client.get(waiting).state(), v1::Job::SUCCEEDED);
  EXPECT_EQ(client.get(done).state(), v1::Job::SUCCEEDED);
  grpc::Status status;
  EXPECT_GT(client.download(done, 0, status).size(), 10'000U);
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

TEST_F(DaemonTest, AHostThatOthersCanReachAndWrongFlagsAreRefused) {
  DaemonProcess open({"--data", data(), "--listen", "0.0.0.0:0"});
  EXPECT_EQ(open.wait(), 1);
  EXPECT_THAT(open.errors(), HasSubstr("--tls-cert FILE --tls-key FILE"));
  DaemonProcess misspelt({"--lisen", "127.0.0.1:0"});
  EXPECT_EQ(misspelt.wait(), 2);
  DaemonProcess none({"--workers", "0"});
  EXPECT_EQ(none.wait(), 2);
}

TEST_F(DaemonTest, HealthAndReflectionAnswer) {
  DaemonProcess daemon({"--data", data(), "--listen", socket()});
  ASSERT_EQ(daemon.wait_for_addresses(1).size(), 1U);
  const auto channel = grpc::CreateChannel(socket(), grpc::InsecureChannelCredentials());
  // HealthCheckResponse{status: SERVING} is field 1 with value 1.
  EXPECT_EQ(call_raw(channel, "/grpc.health.v1.Health/Check", "", false), std::string("\x08\x01"));
  // HealthCheckRequest{service: "cellcrush.v1.Jobs"} is field 1 with that text.
  EXPECT_EQ(call_raw(channel, "/grpc.health.v1.Health/Check",
                     "\x0a\x11"
                     "cellcrush.v1.Jobs",
                     false),
            std::string("\x08\x01"));
  // ServerReflectionRequest{list_services: "*"} is field 7 with that text.
  EXPECT_THAT(call_raw(channel, "/grpc.reflection.v1alpha.ServerReflection/ServerReflectionInfo", "\x3a\x01*", true),
              HasSubstr("cellcrush.v1.Jobs"));
}

}  // namespace
}  // namespace cellcrush::testing
