// Who changed what and whom the daemon refused, in a file of its own.
#include "audit_log.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "access/unix_user.h"
#include "error.h"
#include "programs/certificates.h"
#include "server/daemon_process.h"
#include "server/http/http_socket.h"
#include "server/sweep_requests.h"

namespace cellcrush::testing {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class AuditLogTest : public DaemonFixture {
 protected:
  void SetUp() override {}

  [[nodiscard]] std::filesystem::path file() const { return folder_.path() / "audit.log"; }

  [[nodiscard]] std::vector<json> lines() const {
    std::ifstream file(this->file());
    std::vector<json> out;
    for (std::string line; std::getline(file, line);) out.push_back(json::parse(line));
    return out;
  }

  // "cancelled jobs/1", "started".
  [[nodiscard]] std::vector<std::string> words() const {
    std::vector<std::string> out;
    for (const json& line : lines())
      out.push_back(line["event"] == "change" ? line["action"].get<std::string>() + " " + line.value("resource", "")
                                              : line["event"].get<std::string>());
    return out;
  }
};

TEST_F(AuditLogTest, HasEveryChangeOnceWithItsCaller) {
  auto options = with_workers(1);
  options.audit_log = file();
  start(options);
  struct stat status {};
  ASSERT_EQ(stat(file().c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0600U);
  auto client = this->client();
  auto request = job_of(endless_case());
  request.set_request_id("night \"3\"");
  const std::string job = client.create(request).name();
  client.create(request);  // the same one
  ASSERT_TRUE(client.annotate(job, "watch it").ok());
  ASSERT_TRUE(client.suspend(job).ok());
  ASSERT_TRUE(client.resume(job).ok());
  ASSERT_TRUE(client.cancel(job).ok());
  ASSERT_TRUE(client.wait_for_state(job, v1::Job::CANCELLED));
  ASSERT_TRUE(client.remove(job).ok());
  EXPECT_FALSE(client.remove("jobs/99").ok());
  const auto sweep = create(client, sweep_of(endless_case(), kSpeed, {1.0, 2.0}));
  cancel_sweep(client, sweep.name());
  daemon_->read_files_again();
  daemon_.reset();
  EXPECT_THAT(words(),
              ElementsAre("started", "created " + job, "annotated " + job, "suspended " + job, "resumed " + job,
                          "cancelled " + job, "deleted " + job, "created with 2 jobs " + sweep.name(),
                          "cancelled " + sweep.name(), "reloaded", "stopped"));
  const auto all = lines();
  EXPECT_EQ(all[1]["caller"], access::own_user());
  EXPECT_EQ(all[1]["request"], "night \"3\"");
  EXPECT_THAT(all[1]["time"].get<std::string>(), ::testing::MatchesRegex("20..-..-..T..:..:.*Z"));
}

// A token that is wrong, and one whose scope does not do.
TEST_F(AuditLogTest, HasWhomTheDaemonRefused) {
  auto options = default_options();
  options.audit_log = file();
  options.metrics = "127.0.0.1:0";
  options.http = "127.0.0.1:0";
  write_secret(folder_.path() / "tokens",
               "anna read 5e884898da28047151d0e56f8dc6292773603d0d6aabbdd62a11ef721d1542d8\n");  // of "password"
  options.access.tokens = folder_.path() / "tokens";
  start(options);
  const auto post = [&](const std::string& token) {
    const std::string& url = daemon_->http_url();
    const HttpSocket socket(std::stoi(url.substr(url.rfind(':') + 1)));
    socket.send("POST /cellcrush.v1.Jobs/CreateJob HTTP/1.1\r\nHost: 127.0.0.1\r\nConnection: close\r\n" +
                (token.empty() ? "" : "Authorization: Bearer " + token + "\r\n") +
                "Content-Type: application/json\r\nContent-Length: 2\r\n\r\n{}");
    return socket.read_to_end();
  };
  EXPECT_THAT(post("password"), HasSubstr("403"));
  EXPECT_THAT(post(""), HasSubstr("401"));
  ASSERT_TRUE(wait_until([&] { return lines().size() == 3; }));
  const auto all = lines();
  EXPECT_EQ(all[1]["event"], "refusal");
  EXPECT_EQ(all[1]["caller"], "anna");
  EXPECT_EQ(all[1]["method"], "/cellcrush.v1.Jobs/CreateJob");
  EXPECT_EQ(all[1]["code"], "PERMISSION_DENIED");
  EXPECT_THAT(all[1]["reason"].get<std::string>(), HasSubstr("requires scope submit"));
  EXPECT_EQ(all[2]["code"], "UNAUTHENTICATED");
  EXPECT_FALSE(all[2].contains("caller"));
  EXPECT_THAT(post("a-wrong-one"), HasSubstr("401"));
  ASSERT_TRUE(wait_until([&] { return lines().size() == 4; }));
  EXPECT_EQ(lines()[3].dump().find("wrong-one"), std::string::npos) << "No token is kept.";
}

TEST_F(AuditLogTest, CountsRefusalsThatAreTooMany) {
  AuditLog log(file());
  for (int i = 0; i < 100; ++i) log.note_refusal("/x", "", "UNAUTHENTICATED", "no token");
  EXPECT_TRUE(wait_until([&] { return lines().size() >= AuditLog::kMostRefusals; }));
  EXPECT_TRUE(wait_until([&] {
    log.note_refusal("/y", "", "UNAUTHENTICATED", "no token");
    const auto all = lines();
    return all.back()["method"] == "/y";
  }));
  int told = 0;
  for (const json& line : lines()) told += 1 + std::stoi(line.value("left_out", "0"));
  EXPECT_GE(told, 101);
  EXPECT_LT(lines().size(), 50U);
}

TEST_F(AuditLogTest, AFileThatCannotBeWrittenIsToldAndCallsGoOn) {
  auto options = default_options();
  options.audit_log = folder_.path() / "missing" / "audit.log";
  EXPECT_THROW(start(options), ServiceError);
  const auto pipe = folder_.path() / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THROW(AuditLog{pipe}, ServiceError) << "It would stop whoever writes.";
  AuditLog log("/dev/full");
  const auto before = AuditLog::lost_lines();
  log.note_event("started");
  EXPECT_EQ(AuditLog::lost_lines(), before + 1);
}

TEST_F(AuditLogTest, GoesOnInANewFileOnceItWasMovedAway) {
  AuditLog log(file());
  log.note_event("started");
  std::filesystem::rename(file(), folder_.path() / "audit.log.1");
  log.note_change("jobs/1", "cancelled", "anna\n", "");
  log.reopen();
  log.note_event("stopped");
  EXPECT_THAT(words(), ElementsAre("stopped"));
}

}  // namespace
}  // namespace cellcrush::testing
