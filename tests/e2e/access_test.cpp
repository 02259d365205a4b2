#include <gmock/gmock.h>
#include <sys/stat.h>

#include <csignal>
#include <fstream>
#include <memory>
#include <sstream>

#include "e2e/daemon_test.h"
#include "programs/certificates.h"
#include "programs/temporary_folder.h"

namespace cellcrush::e2e {
namespace {

using cellcrush::testing::Authority;
using cellcrush::testing::CertificateFiles;
using ::testing::HasSubstr;

/// Longest time that a command which is not let in may take.
constexpr double kRefusalSeconds = 3.0;

/// The programs with TLS and tokens, on a port of loopback.
class AccessTest : public ::testing::Test {
 protected:
  void TearDown() override {
    if (!daemon_) return;
    daemon_->send(SIGTERM);
    EXPECT_EQ(daemon_->wait(kShortLimit).exit_code, 0);
  }

  [[nodiscard]] std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

  /// Makes a token with the daemon's command, and puts its line into the file; returns the file of the token.
  std::string make_token(const std::string& name, const std::string& scope) {
    const Outcome made = run({CELLCRUSHD_PROGRAM, "token", name, "--scope", scope}, kShortLimit);
    EXPECT_EQ(made.exit_code, 0) << made.all();
    std::istringstream lines(made.output);
    std::string token;
    std::string line;
    EXPECT_TRUE(std::getline(lines, token) && std::getline(lines, line)) << made.output;
    lines_ += line + "\n";
    cellcrush::testing::write_secret(path("tokens"), lines_);
    cellcrush::testing::write_secret(path(name), token + "\n");
    return path(name);
  }

  /// Starts the daemon on a port, with options; sets port_.
  void start(const std::vector<std::string>& options) {
    std::vector<std::string> command = {CELLCRUSHD_PROGRAM, "--data", path("data"), "--listen",
                                        "127.0.0.1:0",      "--http", "none"};
    command.insert(command.end(), options.begin(), options.end());
    daemon_ = std::make_unique<Process>(command);
    const std::string prefix = "cellcrushd is listening on 127.0.0.1:";
    ASSERT_TRUE(daemon_->wait_for_output(prefix, kShortLimit) && daemon_->wait_for_output("\n", kShortLimit))
        << daemon_->errors();
    const std::string& output = daemon_->output();
    port_ = output.substr(prefix.size(), output.find('\n') - prefix.size());
  }

  [[nodiscard]] std::vector<std::string> tls() const {
    return {"--tls-cert", server_.certificate.string(), "--tls-key", server_.key.string()};
  }

  /// Runs `cellcrush ARGUMENTS... --server HOST:PORT`.
  [[nodiscard]] Outcome cellcrush(std::vector<std::string> arguments, const std::string& host = "127.0.0.1") const {
    arguments.insert(arguments.begin(), CELLCRUSH_PROGRAM);
    arguments.insert(arguments.end(), {"--server", host + ":" + port_});
    return run(arguments, kCrushLimit);
  }

  static void expect_refusal(const Outcome& outcome, int exit_code, const std::string& words) {
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.all();
    EXPECT_THAT(outcome.errors, HasSubstr(words));
    EXPECT_LT(outcome.seconds, kRefusalSeconds) << outcome.errors;
  }

  cellcrush::testing::TemporaryFolder folder_;
  Authority authority_{folder_.path(), "authority"};
  CertificateFiles server_ = authority_.sign("server", {"server", "IP:127.0.0.1"});
  std::string ca_ = authority_.certificate().string();
  std::string lines_;
  std::string port_;
  std::unique_ptr<Process> daemon_;
};

std::vector<std::string> operator+(std::vector<std::string> left, const std::vector<std::string>& right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

TEST_F(AccessTest, AnOwnerOfATokenCrushesOverTlsAndIsNamed) {
  const std::string token = make_token("anna", "submit");
  start(tls() + std::vector<std::string>{"--tokens", path("tokens")});
  std::ofstream(path("case.txtpb")) << small_case();
  const std::vector<std::string> access = {"--tls-ca", ca_, "--token-file", token};
  const Outcome submitted = cellcrush(std::vector<std::string>{"submit", path("case.txtpb"), "--watch"} + access);
  EXPECT_EQ(submitted.exit_code, 0) << submitted.all();
  const Outcome shown = cellcrush(std::vector<std::string>{"show", "jobs/1"} + access);
  EXPECT_THAT(shown.output, ::testing::ContainsRegex("owner +anna"));
  const Outcome mine = cellcrush(std::vector<std::string>{"list", "--filter", "owner = \"anna\""} + access);
  EXPECT_THAT(mine.output, HasSubstr("jobs/1"));
  expect_refusal(cellcrush(std::vector<std::string>{"drain"} + access), 2, "requires scope admin");
}

TEST_F(AccessTest, WhoIsNotLetInIsToldWhyWithinSeconds) {
  const std::string token = make_token("anna", "submit");
  start(tls() + std::vector<std::string>{"--tokens", path("tokens")});
  const Authority other(folder_.path(), "other");
  cellcrush::testing::write_secret(path("wrong"), std::string(64, 'a'));
  cellcrush::testing::write_secret(path("empty"), "");
  expect_refusal(cellcrush({"list", "--tls-ca", ca_}), 2, "--token-file");
  expect_refusal(cellcrush({"list", "--tls-ca", ca_, "--token-file", path("wrong")}), 2,
                 "does not recognise the token");
  expect_refusal(cellcrush({"list", "--tls-ca", ca_, "--token-file", path("empty")}), 2, "is empty");
  expect_refusal(cellcrush({"list", "--tls-ca", path("none"), "--token-file", token}), 2, "--tls-ca " + path("none"));
  expect_refusal(cellcrush({"list", "--tls-ca", path("wrong"), "--token-file", token}), 2, "no CERTIFICATE in PEM");
  expect_refusal(cellcrush({"list", "--tls-ca", other.certificate().string(), "--token-file", token}), 3,
                 "not signed by the authority");
  expect_refusal(cellcrush({"list", "--tls-ca", ca_, "--token-file", token}, "localhost"), 3,
                 "not valid for localhost");
  expect_refusal(cellcrush({"list"}), 3, "name the authority of its certificate with --tls-ca");
  port_ = "50551";
  expect_refusal(cellcrush({"list", "--token-file", token}, "192.0.2.1"), 2, "plain text");
}

TEST_F(AccessTest, AServerThatAsksForACertificateIsShownOne) {
  start(tls() + std::vector<std::string>{"--tls-client-ca", ca_, "--tls-client-scope", "admin"});
  expect_refusal(cellcrush({"list", "--tls-ca", ca_}), 3, "--tls-cert");
  const auto anna = authority_.sign("anna", cellcrush::testing::client_request("anna"));
  const std::vector<std::string> access = {"--tls-ca",       ca_, "--tls-cert", anna.certificate.string(), "--tls-key",
                                           anna.key.string()};
  std::ofstream(path("case.txtpb")) << small_case();
  EXPECT_EQ(cellcrush(std::vector<std::string>{"submit", path("case.txtpb"), "--watch"} + access).exit_code, 0);
  EXPECT_THAT(cellcrush(std::vector<std::string>{"show", "jobs/1"} + access).output,
              ::testing::ContainsRegex("owner +anna"));
  expect_refusal(cellcrush({"list", "--tls-cert", anna.certificate.string(), "--tls-ca", ca_}), 2, "go together");
}

TEST_F(AccessTest, TlsToAServerInPlainTextEndsWithWords) {
  start({});
  expect_refusal(cellcrush({"list", "--tls-ca", ca_}), 3, "does not use TLS");
  EXPECT_EQ(cellcrush({"list"}).exit_code, 0);
}

TEST_F(AccessTest, UnsoundFilesKeepTheDaemonFromStarting) {
  const auto refusal = [this](const std::vector<std::string>& options) {
    const std::vector<std::string> command = {CELLCRUSHD_PROGRAM, "--data", path("data"), "--listen",
                                              "127.0.0.1:0",      "--http", "none"};
    const Outcome outcome = run(command + options, kShortLimit);
    EXPECT_EQ(outcome.exit_code, 1) << outcome.all();
    return outcome.errors;
  };
  EXPECT_THAT(refusal({"--tokens", path("none")}), HasSubstr("--tokens " + path("none")));
  static_cast<void>(make_token("anna", "read"));
  chmod(path("tokens").c_str(), 0644);
  EXPECT_THAT(refusal({"--tokens", path("tokens")}), HasSubstr("is readable by other users"));
  EXPECT_THAT(refusal({"--tls-cert", path("anna"), "--tls-key", server_.key.string()}),
              HasSubstr("--tls-cert " + path("anna")));
  EXPECT_EQ(run({CELLCRUSHD_PROGRAM, "token", "local", "--scope", "admin"}, kShortLimit).exit_code, 2);
  EXPECT_EQ(run({CELLCRUSHD_PROGRAM, "token", "anna", "--scope", "root"}, kShortLimit).exit_code, 2);
}

}  // namespace
}  // namespace cellcrush::e2e
