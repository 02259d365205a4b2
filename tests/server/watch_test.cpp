#include <gmock/gmock.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <thread>

#include "server/daemon_fixture.h"
#include "server/job_numbers.h"
#include "server/small_case.h"
#include "server/watch_contract.h"
#include "store/result_reader.h"

namespace cellcrush::testing {
namespace {

using std::chrono::milliseconds;
using ::testing::HasSubstr;

class WatchTest : public DaemonFixture {
 protected:
  // The numbered events: states and samples.
  static std::vector<v1::JobEvent> numbered(const std::vector<v1::JobEvent>& events) {
    std::vector<v1::JobEvent> out;
    for (const auto& event : events) {
      if (event.has_state() || event.has_sample()) out.push_back(event);
    }
    return out;
  }

  // A watch behind `after` keeps the contract to the job's last state, and ends with OK.
  static void expect_complete(const Client::Watched& watched, std::int64_t after) {
    EXPECT_TRUE(watched.status.ok()) << watched.status.error_message();
    WatchContract contract(after);
    for (const auto& event : watched.events) contract.see(event);
    contract.end(watched.status);
    EXPECT_THAT(contract.broken(), ::testing::IsEmpty());
    ASSERT_FALSE(watched.events.empty());
    EXPECT_EQ(watched.events.back().state().state(), v1::Job::SUCCEEDED);
  }
};

TEST_F(WatchTest, AWatchIsCompleteAndEndsWhenTheResultCanBeRead) {
  auto client = this->client();
  const std::string job = client.create(small_case());
  const auto watched = client.watch(job, 0, true, [&](const v1::JobEvent& event) {
    if (!event.has_state() || event.state().state() != v1::Job::SUCCEEDED) return;
    const auto path = data_folder() / job / "result.h5";
    ASSERT_TRUE(std::filesystem::exists(path));
    EXPECT_GE(store::ResultReader(path).history().size(), 90U);
    EXPECT_FALSE(std::filesystem::exists(path.string() + ".partial"));
  });
  expect_complete(watched, 0);
  int last_frame = -1;
  for (const auto& event : watched.events) {
    if (event.has_frame()) last_frame = event.frame().frame().index();
  }
  const store::ResultReader result(data_folder() / job / "result.h5");
  EXPECT_EQ(last_frame, static_cast<int>(result.frame_times().size()) - 1) << "The last frame is not missed.";
  EXPECT_NEAR(result.history().back().strain(), 0.5, 0.01);
  for (const auto& sample : result.history()) {
    for (const double value : {sample.time_s(), sample.travel_mm(), sample.stress_impact_mpa(),
                               sample.stress_support_mpa(), sample.energy_kinetic_mj(), sample.energy_elastic_mj(),
                               sample.energy_plastic_mj(), sample.energy_contact_mj(), sample.energy_friction_mj(),
                               sample.energy_damping_mj(), sample.work_external_mj(), sample.energy_residual_mj()})
      ASSERT_TRUE(std::isfinite(value)) << sample.DebugString();
  }
  const auto events = numbered(watched.events);
  EXPECT_GE(events.size(), 93U);
  EXPECT_EQ(events[0].state().state(), v1::Job::PENDING);
  EXPECT_EQ(events[1].state().state(), v1::Job::RUNNING);
  EXPECT_GT(events[1].state().worker_pid(), 0);
  EXPECT_EQ(events.back().state().worker_pid(), 0);
  EXPECT_GT(events.back().state().summary().step_count(), 0);
}

TEST_F(WatchTest, TwoWatchersAndALateOneSeeTheSame) {
  auto client = this->client();
  const std::string job = client.create(small_case());
  Client::Watched other;
  std::thread thread([&] { other = this->client().watch(job); });
  const auto one = client.watch(job);
  thread.join();
  const auto late = client.watch(job);
  for (const Client::Watched* watched : std::initializer_list<const Client::Watched*>{&one, &other, &late})
    expect_complete(*watched, 0);
  EXPECT_EQ(numbered(one.events).size(), numbered(other.events).size());
  EXPECT_EQ(numbered(one.events).size(), numbered(late.events).size());
  EXPECT_TRUE(late.events.at(1).has_mesh());
  EXPECT_EQ(late.events.front().snapshot().job().state(), v1::Job::SUCCEEDED);
}

TEST_F(WatchTest, AWatchGoesOnWhereAnotherWasCutOff) {
  auto client = this->client();
  const std::string job = client.create(small_case());
  std::int64_t last = 0;
  {
    v1::WatchJobRequest request;
    request.set_name(job);
    const auto context = bounded_context();
    const auto reader = client.jobs->WatchJob(context.get(), request);
    v1::JobEvent event;
    while (last < 20 && reader->Read(&event)) last = event.sequence();
    context->TryCancel();
    while (reader->Read(&event)) {
    }
    EXPECT_EQ(reader->Finish().error_code(), grpc::StatusCode::CANCELLED);
  }
  ASSERT_EQ(last, 20);
  const auto rest = client.watch(job, last);
  expect_complete(rest, last);
  EXPECT_EQ(rest.events.front().sequence(), last);
  const auto nothing = client.watch(job, rest.events.back().sequence());
  EXPECT_TRUE(nothing.status.ok());
  EXPECT_EQ(nothing.events.size(), 2U) << "The snapshot and the mesh.";
  EXPECT_EQ(client.watch(job, 1'000'000).status.error_code(), grpc::StatusCode::OUT_OF_RANGE);
  EXPECT_EQ(client.watch(job, -1).status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
}

TEST_F(WatchTest, ManyWatchersLeaveRoomForOtherCalls) {
  auto client = this->client();
  const std::string job = client.create(endless_case());
  v1::WatchJobRequest request;
  request.set_name(job);
  std::vector<std::unique_ptr<grpc::ClientContext>> contexts;
  std::vector<std::unique_ptr<grpc::ClientReader<v1::JobEvent>>> readers;
  for (int i = 0; i < 200; ++i) {
    contexts.push_back(bounded_context());
    readers.push_back(client.jobs->WatchJob(contexts.back().get(), request));
  }
  v1::JobEvent event;
  for (const auto& reader : readers) {
    ASSERT_TRUE(reader->Read(&event));
    EXPECT_TRUE(event.has_snapshot());
  }
  EXPECT_EQ(client.get(job).name(), job);
  expect_complete(client.watch(client.create(small_case())), 0);
  for (const auto& context : contexts) context->TryCancel();
}

TEST_F(WatchTest, AWatchOfWhichNothingIsReadIsClosedAndGoesOnWhereItWas) {
  auto options = default_options();
  options.watch_times.patience = milliseconds(500);
  start(options);
  auto client = this->client();
  const std::string job = client.create(endless_case());
  v1::WatchJobRequest request;
  request.set_name(job);
  request.set_frames(true);
  // A connection that does not take more and more by and by: what comes soon is more than it holds.
  grpc::ChannelArguments arguments;
  arguments.SetInt(GRPC_ARG_HTTP2_BDP_PROBE, 0);
  arguments.SetInt(GRPC_ARG_HTTP2_STREAM_LOOKAHEAD_BYTES, 65536);
  Client idle(daemon_->addresses().front(), arguments);
  const auto context = bounded_context();
  const auto reader = idle.jobs->WatchJob(context.get(), request);
  wait_for_samples(client, job, 1500);
  std::this_thread::sleep_for(milliseconds(2000));
  WatchContract seen;
  v1::JobEvent event;
  while (reader->Read(&event)) seen.see(event);
  const grpc::Status status = reader->Finish();
  EXPECT_EQ(status.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED) << status.error_message();
  EXPECT_THAT(status.error_message(), HasSubstr("after_sequence"));
  EXPECT_THAT(seen.broken(), ::testing::IsEmpty());
  EXPECT_GT(seen.sequence(), 0);
  ASSERT_TRUE(client.cancel(job).ok());
  const auto rest = client.watch(job, seen.sequence());
  EXPECT_TRUE(rest.status.ok()) << rest.status.error_message();
  WatchContract contract(seen.sequence());
  for (const auto& later : rest.events) contract.see(later);
  contract.end(rest.status);
  EXPECT_THAT(contract.broken(), ::testing::IsEmpty());
}

}  // namespace
}  // namespace cellcrush::testing
