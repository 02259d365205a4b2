// nginx before the daemon, with the settings of server/reach.md.
#include <gmock/gmock.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <regex>

#include "e2e/daemon_test.h"
#include "programs/certificates.h"

namespace cellcrush::e2e {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::string free_port() {
  const int file = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof(address);
  bind(file, reinterpret_cast<sockaddr*>(&address), size);
  getsockname(file, reinterpret_cast<sockaddr*>(&address), &size);
  close(file);
  return std::to_string(ntohs(address.sin_port));
}

class ProxyTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists("/usr/sbin/nginx")) GTEST_SKIP() << "nginx is not installed";
    const Outcome made = run({CELLCRUSHD_PROGRAM, "token", "anna", "--scope", "submit"}, kShortLimit);
    const auto end = made.output.find('\n');
    token_ = made.output.substr(0, end);
    cellcrush::testing::write_secret(path("tokens"), made.output.substr(end + 1));
    cellcrush::testing::write_secret(path("anna"), token_);
    daemon_ = std::make_unique<Process>(std::vector<std::string>{
        CELLCRUSHD_PROGRAM, "--data", path("data"), "--listen", "127.0.0.1:0", "--http", "127.0.0.1:" + http_port_,
        "--tokens", path("tokens"), "--public-url", "https://localhost:" + port_ + "/crush/"});
    ASSERT_TRUE(daemon_->wait_for_output("\n", kShortLimit)) << daemon_->errors();
    std::smatch found;
    const std::string& output = daemon_->output();
    ASSERT_TRUE(std::regex_search(output, found, std::regex("listening on 127\\.0\\.0\\.1:([0-9]+)"))) << output;
    start_nginx(found[1]);
  }

  void TearDown() override {
    for (Process* process : {nginx_.get(), daemon_.get()}) {
      if (process == nullptr) continue;
      process->send(SIGTERM);
      EXPECT_EQ(process->wait(kShortLimit).exit_code, 0) << process->errors();
    }
  }

  void start_nginx(const std::string& grpc_port) {
    std::ifstream file(std::string(CELLCRUSH_SOURCE_ROOT) + "/server/reach.md");
    const std::string page{std::istreambuf_iterator<char>(file), {}};
    const auto begin = page.find("```nginx\n") + 9;
    std::string settings = page.substr(begin, page.find("```", begin) - begin);
    const auto replace = [&settings](const std::string& old, const std::string& by) {
      ASSERT_NE(settings.find(old), std::string::npos) << old;
      settings.replace(settings.find(old), old.size(), by);
    };
    replace("listen 443 ", "listen 127.0.0.1:" + port_ + " ");
    replace("site.example.org", "localhost");
    replace("127.0.0.1:8080", "127.0.0.1:" + http_port_);
    replace("127.0.0.1:50551", "127.0.0.1:" + grpc_port);
    const auto server = authority_.sign("server");
    std::string files = "access_log off;\n";
    for (const char* use : {"client_body", "proxy", "fastcgi", "uwsgi", "scgi"})
      files += std::string(use) + "_temp_path " + path(use) + ";\n";
    std::ofstream(path("nginx.conf")) << "daemon off;\nerror_log stderr;\npid " << path("pid") << ";\nevents {}\n"
                                      << "http {\n"
                                      << files << "ssl_certificate " << server.certificate.string()
                                      << ";\nssl_certificate_key " << server.key.string() << ";\n"
                                      << settings << "}\n";
    nginx_ = std::make_unique<Process>(std::vector<std::string>{"/usr/sbin/nginx", "-c", path("nginx.conf")});
  }

  [[nodiscard]] std::string curl(const std::string& target, std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"/usr/bin/curl", "-sS", "--retry", "9", "--retry-connrefused", "--cacert",
                               authority_.certificate().string(), "-H", "Authorization: Bearer " + token_,
                               "https://localhost:" + port_ + "/crush" + target});
    const Outcome outcome = run(more, kCrushLimit);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
    return outcome.output;
  }

  [[nodiscard]] std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

  cellcrush::testing::TemporaryFolder folder_;
  cellcrush::testing::Authority authority_{folder_.path(), "authority"};
  std::string port_ = free_port();
  std::string http_port_ = free_port();
  std::string token_;
  std::unique_ptr<Process> daemon_;
  std::unique_ptr<Process> nginx_;
};

TEST_F(ProxyTest, NginxPassesPageCallsStreamsAndDownloadsOn) {
  EXPECT_THAT(curl("/jobs/1"), HasSubstr("src=\"../app.js\""));
  std::ofstream(path("case.txtpb")) << small_case();
  const Outcome watched =
      run({CELLCRUSH_PROGRAM, "submit", path("case.txtpb"), "--watch", "--server", "localhost:" + port_, "--tls-ca",
           authority_.certificate().string(), "--token-file", path("anna")},
          kCrushLimit);
  EXPECT_EQ(watched.exit_code, 0) << watched.all();
  const std::vector<std::string> headers = {"-H", "Origin: https://localhost:" + port_, "-H"};
  auto call = headers;
  call.insert(call.end(), {"Content-Type: application/json", "-d", R"({"name":"jobs/1"})"});
  EXPECT_THAT(curl("/cellcrush.v1.Jobs/GetJob", call), HasSubstr("\"SUCCEEDED\""));
  auto stream = headers;
  const std::string request = R"({"name":"jobs/1"})";
  std::ofstream(path("request")) << std::string("\0\0\0\0", 4) << static_cast<char>(request.size()) << request;
  stream.insert(stream.end(), {"Content-Type: application/connect+json", "--data-binary", "@" + path("request")});
  EXPECT_THAT(curl("/cellcrush.v1.Jobs/WatchJob", stream), AllOf(HasSubstr("\"sample\""), HasSubstr("\"SUCCEEDED\"")));
  const std::string result = curl("/jobs/1/result.h5");
  EXPECT_EQ(curl("/jobs/1/result.h5", {"-r", "1000-"}), result.substr(1000));
}

}  // namespace
}  // namespace cellcrush::e2e
