#include <gmock/gmock.h>

#include "server/daemon_fixture.h"
#include "server/small_case.h"
#include "store/result_reader.h"

namespace cellcrush::testing {
namespace {

struct Series {
  v1::StreamFramesResponse::FrameTimes times;
  v1::Mesh mesh;
  std::vector<v1::FieldFrame> frames;
  grpc::Status status;
};

class StreamFramesTest : public DaemonFixture {
 protected:
  Series series_of(const v1::StreamFramesRequest& request) {
    auto client = this->client();
    const auto context = bounded_context();
    const auto reader = client.jobs->StreamFrames(context.get(), request);
    Series out;
    v1::StreamFramesResponse part;
    while (reader->Read(&part)) {
      out.times.MergeFrom(part.times());
      out.mesh.MergeFrom(part.mesh().mesh());
      if (!part.has_frame()) continue;
      EXPECT_EQ(part.frame().part_count(), 1);
      out.frames.push_back(part.frame().frame());
    }
    out.status = reader->Finish();
    return out;
  }

  static v1::StreamFramesRequest all_of(const std::string& job) { return named<v1::StreamFramesRequest>(job); }

  grpc::StatusCode code_of(const v1::StreamFramesRequest& request) { return series_of(request).status.error_code(); }
};

TEST_F(StreamFramesTest, AnEndedJobSendsTheFramesOfItsResult) {
  const std::string job = finished_job();
  const store::ResultReader result(data_folder() / job / "result.h5");
  const auto series = series_of(all_of(job));
  ASSERT_TRUE(series.status.ok()) << series.status.error_message();
  const auto times = result.frame_times();
  ASSERT_EQ(series.frames.size(), times.size());
  ASSERT_EQ(series.times.time_s_size(), static_cast<int>(times.size()));
  EXPECT_EQ(series.mesh.position_mm_size(), 2 * series.mesh.particle_count());
  for (std::size_t i = 0; i < times.size(); ++i) {
    EXPECT_EQ(series.times.time_s(static_cast<int>(i)), times[i]);
    EXPECT_EQ(series.frames[i].SerializeAsString(), result.frame(static_cast<int>(i)).SerializeAsString());
  }
  EXPECT_EQ(series.frames.front().position_mm().Get(0), series.mesh.position_mm(0)) << "Frame 0 is before loading.";
}

TEST_F(StreamFramesTest, SomeFramesCanBeAskedForInEitherForm) {
  const std::string job = finished_job();
  auto request = all_of(job);
  const auto all = series_of(request);
  request.set_from(1);
  request.set_to(8);
  request.set_stride(3);
  request.set_encoding(v1::FieldFrame::PACKED);
  const auto some = series_of(request);
  ASSERT_EQ(some.frames.size(), 3U);
  EXPECT_EQ(some.times.time_s_size(), all.times.time_s_size());
  std::size_t numbers = 0;
  std::size_t packed = 0;
  for (int i = 0; i < 3; ++i) {
    const auto& frame = some.frames[static_cast<std::size_t>(i)];
    EXPECT_EQ(frame.index(), 1 + 3 * i);
    EXPECT_EQ(frame.packed().particle_count(), all.mesh.particle_count());
    packed += frame.ByteSizeLong();
    numbers += all.frames[static_cast<std::size_t>(frame.index())].ByteSizeLong();
  }
  EXPECT_LT(2 * packed, numbers);
}

TEST_F(StreamFramesTest, ARunningOrSuspendedJobSendsTheFramesSoFar) {
  auto client = this->client();
  const std::string job = client.create(case_of_seconds());
  auto request = named<v1::WatchJobRequest>(job);
  request.set_frames(true);
  const auto context = bounded_context();
  const auto reader = client.jobs->WatchJob(context.get(), request);
  v1::JobEvent event;
  int newest = -1;
  while (newest < 2 && reader->Read(&event)) {
    if (event.has_frame()) newest = event.frame().frame().index();
  }
  const auto running = series_of(all_of(job));
  EXPECT_TRUE(running.status.ok()) << running.status.error_message();
  EXPECT_GT(static_cast<int>(running.frames.size()), newest);
  EXPECT_TRUE(client.suspend(job).ok());
  const auto suspended = series_of(all_of(job));
  EXPECT_GE(suspended.frames.size(), running.frames.size());
  for (std::size_t i = 0; i < suspended.frames.size(); ++i) EXPECT_EQ(suspended.frames[i].index(), static_cast<int>(i));
  EXPECT_TRUE(client.resume(job).ok());
  while (reader->Read(&event)) continue;
  EXPECT_TRUE(reader->Finish().ok());
  const auto ended = series_of(all_of(job));
  ASSERT_GT(ended.frames.size(), suspended.frames.size());
  for (std::size_t i = 0; i < suspended.frames.size(); ++i)
    EXPECT_EQ(ended.frames[i].SerializeAsString(), suspended.frames[i].SerializeAsString()) << i;
}

TEST_F(StreamFramesTest, WhatIsNotThereIsRefused) {
  const std::string job = finished_job();
  EXPECT_EQ(code_of(all_of("jobs/99")), grpc::StatusCode::NOT_FOUND);
  auto request = all_of(job);
  request.set_from(-1);
  EXPECT_EQ(code_of(request), grpc::StatusCode::INVALID_ARGUMENT);
  request.set_from(1000);
  EXPECT_EQ(code_of(request), grpc::StatusCode::OUT_OF_RANGE);
  request.set_from(5);
  request.set_to(4);
  EXPECT_EQ(code_of(request), grpc::StatusCode::INVALID_ARGUMENT);
  request.set_to(1000);
  EXPECT_EQ(code_of(request), grpc::StatusCode::OK) << "As far as there are frames.";
  request.set_stride(-1);
  EXPECT_EQ(code_of(request), grpc::StatusCode::INVALID_ARGUMENT);
  auto client = this->client();
  const std::string first = client.create(endless_case());
  for (int i = 0; i < 64; ++i) client.create(endless_case());
  const std::string waiting = client.create(endless_case());
  EXPECT_EQ(code_of(all_of(waiting)), grpc::StatusCode::FAILED_PRECONDITION);
}

}  // namespace
}  // namespace cellcrush::testing
