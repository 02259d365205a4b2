// Tasks that reach the daemon over the network: with TLS, and with a token of their own.
#include <gmock/gmock.h>

#include "server/gate_fixture.h"
#include "server/small_case.h"
#include "server/sweep_requests.h"
#include "slurm/cluster_flag.h"
#include "slurm/kept_daemon.h"
#include "slurm/network_link.h"
#include "slurm/slurm_cluster.h"
#include "slurm/workers_service.h"

namespace cellcrush::testing {
namespace {

using ::testing::HasSubstr;

class SlurmNetworkTest : public GateFixture {
 protected:
  void SetUp() override {
    if (!slurm_is_installed()) GTEST_SKIP() << kSlurmIsMissing;
    GateFixture::SetUp();
    cluster_ = std::make_unique<SlurmCluster>();
    setenv("SLURM_CONF", cluster_->config().c_str(), 1);
    address_ = "127.0.0.1:" + std::to_string(port_.number());
  }

  // A daemon with TLS and tokens, whose tasks know the authority.
  [[nodiscard]] DaemonOptions with_cluster(std::chrono::milliseconds lease = std::chrono::seconds(30)) const {
    auto options = with_tokens(with_tls(tcp_options(address_)));
    auto cluster = slurm::parse_cluster("test:daemon=" + address_ + ",ca=" + authority_.certificate().string() +
                                        ",program=" CELLCRUSHD_PROGRAM ",task-length=0");
    cluster.times.look = std::chrono::milliseconds(200);
    cluster.times.squeue = std::chrono::milliseconds(2'000);
    cluster.times.lease = lease;
    options.executors.push_back(slurm::executor_of(cluster));
    options.default_executor = "slurm/test";
    return options;
  }

  // The attempts that are open.
  [[nodiscard]] std::vector<slurm::AttemptFolder> attempts() const {
    std::vector<slurm::AttemptFolder> out;
    for (const auto& entry : std::filesystem::directory_iterator(data_folder() / "slurm/test/attempts"))
      out.emplace_back(entry.path());
    return out;
  }

  const ReservedPort port_;
  std::unique_ptr<SlurmCluster> cluster_;
  std::string address_;
};

TEST_F(SlurmNetworkTest, ASweepOverTlsHasTheBitsOfALocalOne) {
  start(with_cluster());
  Client client = this->client();
  auto request = sweep_of(case_of_seconds(), kSpeed, {2.0, 3.0, 5.0, 8.0});
  const auto there = create(client, request);
  request.mutable_sweep()->set_executor("local");
  const auto here = create(client, request);
  ASSERT_TRUE(wait_for_count(client, here.name(), v1::Job::SUCCEEDED, 4));
  ASSERT_TRUE(wait_for_count(client, there.name(), v1::Job::SUCCEEDED, 4)) << cluster_->logs();
  for (int i = 0; i < 4; ++i) {
    const auto expected = client.history(get_sweep(client, here.name()).jobs(i));
    const auto history = client.history(get_sweep(client, there.name()).jobs(i));
    ASSERT_EQ(history.size(), expected.size());
    for (std::size_t k = 0; k < history.size(); ++k)
      ASSERT_EQ(history[k].SerializeAsString(), expected[k].SerializeAsString()) << k;
    grpc::Status status;
    EXPECT_GT(client.download(get_sweep(client, there.name()).jobs(i), 0, status).size(), 10'000U);
  }
}

TEST_F(SlurmNetworkTest, ATaskGoesOnWhileTheDaemonIsAwayAndTheNextOneContinuesIt) {
  start(with_cluster());
  auto slow = case_of_seconds();
  slow.mutable_loading()->set_speed_m_per_s(0.5);
  std::string job;
  {
    Client client = this->client();
    job = client.create(slow);
    ASSERT_TRUE(client.wait_for_state(job, v1::Job::RUNNING));
  }
  daemon_.reset();
  std::this_thread::sleep_for(std::chrono::seconds(3));
  start(with_cluster());
  Client client = this->client();
  EXPECT_TRUE(client.watch(job).status.ok());
  EXPECT_EQ(client.get(job).state(), v1::Job::SUCCEEDED) << client.get(job).cause_message();
  EXPECT_EQ(client.get(job).attempt(), 1);
}

// Its lease is over: it leaves the job at a checkpoint, and hands it over when the daemon is back.
TEST_F(SlurmNetworkTest, ATaskWithoutItsDaemonForLongLeavesTheJobAtACheckpoint) {
  start(with_cluster(std::chrono::seconds(1)));
  std::string job;
  {
    Client client = this->client();
    job = client.create(endless_case());
    ASSERT_TRUE(client.wait_for_state(job, v1::Job::RUNNING));
  }
  daemon_.reset();
  // Longer than a call that was under way waits.
  std::this_thread::sleep_for(std::chrono::seconds(40));
  start(with_cluster());
  Client client = this->client();
  std::string message;
  for (int i = 0; i < 200 && message.empty(); ++i) {
    message = client.get(job).cause_message();
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  EXPECT_THAT(message, HasSubstr("lost its connection to the daemon"));
  ASSERT_TRUE(client.wait_for_state(job, v1::Job::RUNNING));
  EXPECT_EQ(client.get(job).attempt(), 2);
  EXPECT_TRUE(client.cancel(job).ok());
  EXPECT_TRUE(client.wait_for_state(job, v1::Job::CANCELLED));
}

TEST_F(SlurmNetworkTest, ATokenIsGoodForItsOwnAttemptAndNothingElse) {
  start(with_cluster());
  Client client = this->client();
  const std::string first = client.create(endless_case());
  const std::string second = client.create(endless_case());
  ASSERT_TRUE(client.wait_for_state(first, v1::Job::RUNNING));
  ASSERT_TRUE(client.wait_for_state(second, v1::Job::RUNNING));
  const auto open = attempts();
  ASSERT_EQ(open.size(), 2U);
  const auto id_of = [](const auto& folder) { return folder.root().filename().string(); };
  const auto channel = slurm::open_channel({address_, authority_.certificate().string()});
  const std::string token = open[0].token().value();
  EXPECT_EQ(slurm::NetworkLink(channel, "test", id_of(open[0]), token).requested(), slurm::Request::NONE);
  for (const std::string wrong : {"", "0", "../test/attempts/"})
    EXPECT_EQ(slurm::NetworkLink(channel, "test", id_of(open[0]), wrong).requested(), slurm::Request::ABANDON);
  EXPECT_EQ(slurm::NetworkLink(channel, "test", id_of(open[1]), token).requested(), slurm::Request::ABANDON);
  EXPECT_EQ(slurm::NetworkLink(channel, "test", "../attempts/" + id_of(open[0]), token).requested(),
            slurm::Request::ABANDON);
  // It is not a token of the API.
  Visitor visitor;
  visitor.authority = authority_.certificate();
  visitor.token = token;
  const auto jobs = v1::Jobs::NewStub(slurm::open_channel({address_, authority_.certificate().string()}));
  v1::Job unused;
  v1::GetJobRequest request;
  request.set_name(first);
  const auto context = bounded_context();
  context->AddMetadata("authorization", "Bearer " + token);
  EXPECT_EQ(jobs->GetJob(context.get(), request, &unused).error_code(), grpc::StatusCode::UNAUTHENTICATED);
  // Nor one that is valid after the end.
  EXPECT_TRUE(client.cancel(first).ok());
  EXPECT_TRUE(client.cancel(second).ok());
  ASSERT_TRUE(client.wait_for_state(first, v1::Job::CANCELLED));
  ASSERT_TRUE(client.wait_for_state(second, v1::Job::CANCELLED));
  EXPECT_EQ(slurm::NetworkLink(channel, "test", id_of(open[0]), token).requested(), slurm::Request::ABANDON);
  EXPECT_EQ(attempts().size(), 0U);
}

}  // namespace
}  // namespace cellcrush::testing
