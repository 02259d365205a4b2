// Health means progress: what probes are told when a loop is stuck, when the daemon drains, and by the daemon itself.
#include <gmock/gmock.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <cstring>

#include "heartbeats.h"
#include "log_format.h"
#include "open_file.h"
#include "server/daemon_process.h"
#include "server/held_point.h"
#include "server/http/http_fixture.h"
#include "server/log_capture.h"
#include "store/sqlite.h"

namespace cellcrush::testing {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class HealthTest : public HttpFixture {
 protected:
  [[nodiscard]] DaemonOptions impatient() const {
    DaemonOptions options = http_options();
    options.heartbeats.interval = std::chrono::milliseconds(50);
    return options;
  }

  [[nodiscard]] std::string get(const std::string& path) const { return exchange(request("GET " + path, "")); }
};

TEST_F(HealthTest, AJournalThatTakesNoWritesIsNamedUntilItDoes) {
  const LogCapture log(make_text_formatter());
  std::atomic<int> progress = 0;
  DaemonOptions options = impatient();
  options.on_progress = [&progress] { ++progress; };
  start(options);
  const Client client = this->client();
  EXPECT_THAT(get("/readyz"), AllOf(StartsWith("HTTP/1.1 200"), EndsWith("\r\nThe daemon takes jobs.\n")));
  EXPECT_THAT(get("/healthz?verbose"), AllOf(StartsWith("HTTP/1.1 200"), EndsWith("\r\nThe daemon makes progress.\n")));
  EXPECT_TRUE(wait_until([&] { return progress > 1; }));

  store::Database other(data_folder() / "journal.sqlite", store::Database::Access::shared);
  other.execute("BEGIN EXCLUSIVE");
  ASSERT_TRUE(wait_until([&] { return get("/readyz").starts_with("HTTP/1.1 503"); }));
  for (const char* path : {"/readyz", "/healthz"})
    EXPECT_THAT(get(path),
                AllOf(StartsWith("HTTP/1.1 503"), HasSubstr("\r\nThe journal has made no progress since 2")));
  const int before = progress;
  EXPECT_FALSE(is_serving(client, ""));
  EXPECT_FALSE(is_serving(client, "cellcrush.v1.Jobs"));
  EXPECT_EQ(log.count_lines("[error] The journal has made no progress since"), 1) << log.text();
  EXPECT_EQ(progress, before) << "The watchdog is not told that all is well.";

  other.execute("COMMIT");
  EXPECT_TRUE(wait_until([&] { return get("/readyz").starts_with("HTTP/1.1 200"); }));
  EXPECT_TRUE(is_serving(client, "cellcrush.v1.Jobs"));
  EXPECT_EQ(log.count_lines("The journal makes progress again"), 1) << log.text();
}

TEST_F(HealthTest, HousekeepingAndCallsThatStandStillAreNamed) {
  HeldPoint point;
  DaemonOptions options = impatient();
  options.heartbeats.patience = 1;
  options.connections.threads = 1;
  options.clocks.wall = [&point, is_first = std::make_shared<std::atomic<bool>>(true)] {
    if (!is_first->exchange(false)) point.stand();  // the daemon's start reads it once
    return Clocks::read(CLOCK_REALTIME);
  };
  start(options);
  ASSERT_TRUE(point.wait());
  EXPECT_TRUE(wait_until([&] { return get("/readyz").find("Housekeeping has made no") != std::string::npos; }));
  point.open();
  EXPECT_TRUE(wait_until([&] { return get("/readyz").starts_with("HTTP/1.1 200"); }));

  const std::string job = client().create(small_case(), v1::Job::SUCCEEDED);
  store::Database other(data_folder() / "journal.sqlite", store::Database::Access::shared);
  other.execute("BEGIN EXCLUSIVE");
  std::jthread blocked([&] { static_cast<void>(client().annotate(job, "waits for the journal")); });
  EXPECT_TRUE(wait_until([&] { return get("/readyz").find("The pool of calls has made no") != std::string::npos; }));
  other.execute("COMMIT");
}

TEST_F(HealthTest, ADaemonThatDrainsIsAliveAndTakesNoJobs) {
  start(with_tokens(impatient()));
  const Client client = this->client();
  v1::Admin::Stub admin(client.channel);
  v1::DrainResponse drained;
  ASSERT_TRUE(admin.Drain(bounded_context().get(), {}, &drained).ok());
  EXPECT_THAT(get("/readyz"), AllOf(StartsWith("HTTP/1.1 503"), HasSubstr("drains"))) << "No token is needed.";
  EXPECT_THAT(get("/healthz"), StartsWith("HTTP/1.1 200"));
  EXPECT_FALSE(is_serving(client, "cellcrush.queue"));
}

TEST_F(HealthTest, AHeadHasTheStatusAndNoBody) {
  start(impatient());
  for (const char* path : {"/readyz", "/none"})
    EXPECT_THAT(exchange(request(std::string("HEAD ") + path, "")),
                AllOf(HasSubstr("Content-Length: "), EndsWith("\r\n\r\n")));
}

TEST_F(HealthTest, AStuckLoopHoldsUpNoOtherAndNoEnd) {
  std::atomic<bool> is_told = false;
  std::atomic<int> beats = 0;
  const auto hang = [](const Heartbeats::Beat&) {};
  const auto beat = [&beats](const Heartbeats::Beat& done) {
    ++beats;
    done();
  };
  const Heartbeats hearts({{"A", hang}, {"B", beat}}, {std::chrono::milliseconds(20), 10},
                          [&is_told](const std::string& stuck) { is_told = stuck.starts_with("A has made no"); });
  EXPECT_TRUE(wait_until([&] { return is_told.load() && beats > 10; }));
}

TEST_F(HealthTest, SystemdIsToldOfStartProgressAndEnd) {
  const OpenFile told(socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  const std::string path = (folder_.path() / "notify").string();
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, path.c_str(), sizeof(address.sun_path) - 1);
  ASSERT_EQ(bind(told.get(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
  const timeval limit{20, 0};
  setsockopt(told.get(), SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof(limit));
  const auto next = [&told] {
    std::string text(100, '\0');
    text.resize(static_cast<std::size_t>(std::max<ssize_t>(0, recv(told.get(), text.data(), text.size(), 0))));
    return text;
  };
  setenv("NOTIFY_SOCKET", path.c_str(), 1);
  DaemonProcess daemon({"--data", data_folder(), "--listen", "unix:" + (folder_.path() / "s").string()});
  unsetenv("NOTIFY_SOCKET");
  std::string got = next();
  if (got == "WATCHDOG=1") got = next();
  EXPECT_EQ(got, "READY=1");
  EXPECT_EQ(next(), "WATCHDOG=1");
  daemon.send_signal(SIGTERM);
  for (got = next(); got == "WATCHDOG=1";) got = next();
  EXPECT_EQ(got, "STOPPING=1");
  EXPECT_EQ(daemon.wait(), 0);
}

}  // namespace
}  // namespace cellcrush::testing
