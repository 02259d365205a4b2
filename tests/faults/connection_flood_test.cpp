// Strangers who open more connections and streams than the daemon has room for.
#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <netinet/in.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <deque>
#include <fstream>
#include <iostream>
#include <thread>

#include "access/token_file.h"
#include "faults/fault_fixture.h"
#include "grpc/health/v1/health.grpc.pb.h"
#include "programs/certificates.h"
#include "server/small_case.h"

namespace cellcrush::testing {
namespace {

using grpc::health::v1::Health;
using grpc::health::v1::HealthCheckRequest;
using grpc::health::v1::HealthCheckResponse;
using std::chrono::milliseconds;
using std::chrono::seconds;

// A connection of TCP that says nothing, or -1.
int connect_to(int port) {
  const int out = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in name{};
  name.sin_family = AF_INET;
  name.sin_port = htons(static_cast<std::uint16_t>(port));
  name.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (out >= 0 && connect(out, reinterpret_cast<const sockaddr*>(&name), sizeof(name)) == 0) return out;
  if (out >= 0) close(out);
  return -1;
}

void reset(int connection) {
  const linger at_once{1, 0};
  setsockopt(connection, SOL_SOCKET, SO_LINGER, &at_once, sizeof(at_once));
  close(connection);
}

// A Health.Watch from which the first message, or the refusal, is taken.
class Watch final : public grpc::ClientReadReactor<HealthCheckResponse> {
 public:
  Watch(Health::Stub& stub, std::atomic<int>& answered, std::atomic<int>& open) : answered_(answered), open_(open) {
    ++open_;
    stub.async()->Watch(&context_, &request_, this);
    StartRead(&response_);
    StartCall();
  }
  void cancel() { context_.TryCancel(); }
  void OnReadDone(bool ok) override {
    if (!answered_before_) ++answered_;
    answered_before_ = true;
    if (ok) StartRead(&response_);
  }
  void OnDone(const grpc::Status& status) override {
    if (status.error_code() == grpc::StatusCode::RESOURCE_EXHAUSTED) refused_ = true;
    --open_;
  }
  [[nodiscard]] bool refused() const { return refused_; }

 private:
  std::atomic<int>& answered_;
  std::atomic<int>& open_;
  grpc::ClientContext context_;
  HealthCheckRequest request_;
  HealthCheckResponse response_;
  bool answered_before_ = false;
  std::atomic<bool> refused_ = false;
};

enum class Port { plain, tls };

class ConnectionFloodTest : public FaultFixture, public ::testing::WithParamInterface<Port> {
 protected:
  void SetUp() override {
    // This process holds the other end of each connection.
    rlimit limit{};
    getrlimit(RLIMIT_NOFILE, &limit);
    limit.rlim_cur = limit.rlim_max;
    setrlimit(RLIMIT_NOFILE, &limit);
    start();
  }

  void start(int most_descriptors = 0) {
    std::vector<std::string> arguments = {"--data",   data_folder().string(), "--listen",  address(),
                                          "--listen", "127.0.0.1:0",          "--workers", "1"};
    if (GetParam() == Port::tls) {
      const auto server = authority_.sign("server");
      for (const auto& word :
           {std::string("--tls-cert"), server.certificate.string(), std::string("--tls-key"), server.key.string()})
        arguments.push_back(word);
    }
    daemon_ = std::make_unique<DaemonProcess>(arguments, most_descriptors);
    const auto addresses = daemon_->wait_for_addresses(2);
    ASSERT_EQ(addresses.size(), 2U);
    tcp_address_ = addresses.back();
    port_ = std::stoi(tcp_address_.substr(tcp_address_.rfind(':') + 1));
  }

  [[nodiscard]] std::shared_ptr<grpc::Channel> channel() const {
    grpc::ChannelArguments arguments;
    arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
    arguments.SetInt(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, 200);
    arguments.SetInt(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, 200);
    auto credentials = grpc::InsecureChannelCredentials();
    if (GetParam() == Port::tls) {
      grpc::SslCredentialsOptions options;
      options.pem_root_certs = text_of_file(authority_.certificate());
      credentials = grpc::SslCredentials(options);
    }
    return grpc::CreateCustomChannel(tcp_address_, credentials, arguments);
  }

  // Whether a new connection is served within so long. One that is turned away tries again.
  [[nodiscard]] grpc::Status check(const std::shared_ptr<grpc::Channel>& to, milliseconds patience = seconds(5)) const {
    const auto deadline = std::chrono::system_clock::now() + patience;
    for (;;) {
      grpc::ClientContext context;
      context.set_wait_for_ready(true);
      context.set_deadline(deadline);
      HealthCheckResponse response;
      auto status = Health::NewStub(to)->Check(&context, HealthCheckRequest(), &response);
      if (status.ok() || std::chrono::system_clock::now() >= deadline) return status;
      std::this_thread::sleep_for(milliseconds(100));
    }
  }

  void expect_all_ports_answer() const {
    EXPECT_TRUE(check(channel()).ok()) << tcp_address_;
    EXPECT_TRUE(check(client().channel).ok()) << address();
  }

  [[nodiscard]] int threads() const {
    std::ifstream status("/proc/" + std::to_string(daemon_->number()) + "/status");
    std::string word;
    int out = 0;
    while (status >> word) {
      if (word == "Threads:" && status >> out) break;
    }
    return out;
  }

  // The daemon's own limit on descriptors, from now on: how many it may open beyond those that it has.
  void leave_descriptors(int more) const {
    int highest = 0;
    for (const auto& entry : std::filesystem::directory_iterator("/proc/" + std::to_string(daemon_->number()) + "/fd"))
      highest = std::max(highest, std::stoi(entry.path().filename().string()));
    const rlimit limit{static_cast<rlim_t>(highest + 1 + more), 20000};
    ASSERT_EQ(prlimit(daemon_->number(), RLIMIT_NOFILE, &limit, nullptr), 0);
  }

  Authority authority_{folder_.path(), "authority"};
  std::string tcp_address_;
  int port_ = 0;
};

std::string name_of_port(const ::testing::TestParamInfo<Port>& parameter) {
  return parameter.param == Port::tls ? "Tls" : "Plain";
}
INSTANTIATE_TEST_SUITE_P(Over, ConnectionFloodTest, ::testing::Values(Port::plain, Port::tls), name_of_port);

TEST_P(ConnectionFloodTest, APortThatRanOutOfDescriptorsAnswersAgain) {
  leave_descriptors(100);
  std::vector<int> open;
  open.reserve(1010);
  for (int i = 0; i < 1010; ++i) open.push_back(connect_to(port_));
  std::this_thread::sleep_for(seconds(1));
  for (const int connection : open) close(connection);
  expect_all_ports_answer();
}

TEST_P(ConnectionFloodTest, StrangersUnderAHardLimitOf1024DescriptorsShutNobodyOut) {
  daemon_.reset();
  start(1024);
  std::vector<int> open;
  open.reserve(1010);
  for (int i = 0; i < 1010; ++i) open.push_back(connect_to(port_));
  std::this_thread::sleep_for(seconds(1));
  EXPECT_TRUE(check(client().channel).ok()) << "The Unix socket has connections of its own.";
  for (const int connection : open) close(connection);
  expect_all_ports_answer();
}

TEST_P(ConnectionFloodTest, FloodsLeaveEveryPortThreadsAndMemoryAsTheyWere) {
  auto local = this->client();
  const std::string job = local.create(small_case(), v1::Job::SUCCEEDED);
  expect_all_ports_answer();
  const std::size_t before = daemon_->resident_bytes();
  const int threads_before = threads();
  int most_threads = threads_before;
  std::size_t most_memory = before;
  const auto look = [&] {
    most_threads = std::max(most_threads, threads());
    most_memory = std::max(most_memory, daemon_->resident_bytes());
  };

  for (const bool resets : {false, true}) {
    std::deque<int> open;
    for (int i = 0; i < rounds(2000, 20000); ++i) {
      open.push_back(connect_to(port_));
      if (open.size() < 1500) continue;
      resets ? reset(open.front()) : static_cast<void>(close(open.front()));
      open.pop_front();
    }
    look();
    for (const int connection : open) resets ? reset(connection) : static_cast<void>(close(connection));
    expect_all_ports_answer();
  }

  int refused_watches = 0;
  for (int batch = 0; batch < rounds(1, 10); ++batch) {
    std::atomic<int> answered = 0;
    std::atomic<int> open = 0;
    std::vector<std::unique_ptr<Health::Stub>> stubs;
    stubs.reserve(20);
    for (int i = 0; i < 20; ++i) stubs.push_back(Health::NewStub(channel()));
    std::vector<std::unique_ptr<Watch>> watches;
    watches.reserve(5000);
    for (int i = 0; i < 5000; ++i)
      watches.push_back(std::make_unique<Watch>(*stubs[static_cast<std::size_t>(i) % stubs.size()], answered, open));
    EXPECT_TRUE(wait_until(
        [&] {
          look();
          return answered == 5000;
        },
        seconds(30)));
    for (const auto& watch : watches) watch->cancel();
    ASSERT_TRUE(wait_until([&open] { return open == 0; }, seconds(30)));
    for (const auto& watch : watches) refused_watches += watch->refused() ? 1 : 0;
    stubs.clear();
    expect_all_ports_answer();
  }
  EXPECT_GT(refused_watches, 0) << "Some are beyond --max-streams.";

  {
    std::vector<std::unique_ptr<v1::Jobs::Stub>> stubs;
    stubs.reserve(4);
    for (int i = 0; i < 4; ++i) stubs.push_back(v1::Jobs::NewStub(channel()));
    std::deque<grpc::ClientContext> contexts;
    std::vector<std::unique_ptr<grpc::ClientReader<v1::DownloadResultResponse>>> readers;
    auto request = named<v1::DownloadResultRequest>(job);
    for (std::size_t i = 0; i < 1100; ++i)
      readers.push_back(stubs[i % stubs.size()]->DownloadResult(&contexts.emplace_back(), request));
    std::this_thread::sleep_for(milliseconds(rounds(500, 2000)));
    look();
    EXPECT_TRUE(check(channel()).ok());
    EXPECT_EQ(local.get(job).state(), v1::Job::SUCCEEDED);
    for (auto& context : contexts) context.TryCancel();
    for (auto& reader : readers) {
      v1::DownloadResultResponse part;
      while (reader->Read(&part)) continue;
      (void)reader->Finish();
    }
  }
  expect_all_ports_answer();

  std::size_t after = daemon_->resident_bytes();
  for (int i = 0; i < 200 && after > before + (100U << 20U); ++i) {
    std::this_thread::sleep_for(milliseconds(50));
    after = daemon_->resident_bytes();
  }
  std::cout << "threads " << threads_before << " before, at most " << most_threads << ", memory " << before / 1048576
            << " MiB before, at most " << most_memory / 1048576 << ", " << after / 1048576 << " after; "
            << refused_watches << " watches refused\n";
  EXPECT_LT(most_threads, threads_before + 12) << "those of gRPC's own that a flood adds";
  EXPECT_LT(after, before + (100U << 20U));
}

}  // namespace
}  // namespace cellcrush::testing
