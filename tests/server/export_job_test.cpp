// The frames of a job, and the file it is exported to.
#include <gmock/gmock.h>
#include <openssl/evp.h>
#include <zlib.h>

#include <algorithm>

#include "server/daemon_fixture.h"
#include "server/small_case.h"
#include "store/result_reader.h"

namespace cellcrush::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

struct Export {
  std::string file;
  v1::ExportJobResponse last;  ///< without its data
  grpc::Status status;
};

std::string from_base64(const std::string& text) {
  std::string out(text.size(), '\0');
  const int size = EVP_DecodeBlock(reinterpret_cast<unsigned char*>(out.data()),
                                   reinterpret_cast<const unsigned char*>(text.data()), static_cast<int>(text.size()));
  EXPECT_GE(size, 0) << "not base64";
  const auto padding = static_cast<std::size_t>(std::count(text.begin(), text.end(), '='));
  out.resize(static_cast<std::size_t>(std::max(size, 0)) - padding);
  return out;
}

std::string inflated(const std::string& bytes) {
  constexpr uLongf kMost = 50'000'000;
  uLongf size = kMost;
  std::string out;
  out.resize(size);
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                       bytes.size()),
            Z_OK);
  out.resize(size);
  return out;
}

// The messages with which the file answers a call.
template <class Message>
std::vector<Message> answers_of(const std::string& file, const std::string& call) {
  std::vector<Message> out;
  const std::string begin = R"(<script type="application/x-protobuf" data-call=")" + call + '"';
  for (auto at = file.find(begin); at != std::string::npos; at = file.find(begin, at + 1)) {
    const auto text = file.find('>', at) + 1;
    const bool is_small = file.compare(at + begin.size(), 10, " data-zlib") == 0;
    const std::string bytes = from_base64(file.substr(text, file.find('<', text) - text));
    EXPECT_TRUE(out.emplace_back().ParseFromString(is_small ? inflated(bytes) : bytes));
  }
  return out;
}

class ExportJobTest : public DaemonFixture {
 protected:
  Export export_of(const std::string& job, std::int64_t max_bytes = 0) {
    auto client = this->client();
    const auto context = bounded_context();
    auto request = named<v1::ExportJobRequest>(job);
    request.set_max_bytes(max_bytes);
    const auto reader = client.jobs->ExportJob(context.get(), request);
    Export out;
    v1::ExportJobResponse chunk;
    while (reader->Read(&chunk)) {
      EXPECT_LE(chunk.data().size(), 128U * 1024U);
      EXPECT_GE(chunk.fraction(), out.last.fraction());
      out.file += chunk.data();
      out.last = chunk;
    }
    out.last.clear_data();
    out.status = reader->Finish();
    return out;
  }
};

TEST_F(ExportJobTest, TheFileHasTheAnswersOfTheDaemon) {
  const std::string job = finished_job();
  const Export exported = export_of(job);
  ASSERT_TRUE(exported.status.ok()) << exported.status.error_message();
  EXPECT_THAT(exported.file, StartsWith("<!doctype html>\n<!-- cellcrush export -->\n"));
  auto client = this->client();
  const auto jobs = answers_of<v1::Job>(exported.file, "GetJob");
  ASSERT_EQ(jobs.size(), 1U);
  EXPECT_EQ(jobs[0].SerializeAsString(), client.get(job).SerializeAsString());
  const auto history = answers_of<v1::GetHistoryResponse>(exported.file, "GetHistory");
  ASSERT_EQ(history.size(), 1U);
  EXPECT_EQ(history[0].samples_size(), static_cast<int>(client.history(job).size()));
  EXPECT_EQ(history[0].next_page_token(), "");
  const auto checks = answers_of<v1::CheckCaseResponse>(exported.file, "CheckCase");
  ASSERT_EQ(checks.size(), 1U);
  EXPECT_GT(checks[0].modelled_size(), 0);
  const auto series = answers_of<v1::StreamFramesResponse>(exported.file, "StreamFrames");
  ASSERT_GE(series.size(), 3U);
  ASSERT_TRUE(series[0].has_times());
  EXPECT_TRUE(series[1].has_mesh());
  const int frames = series[0].times().time_s_size();
  EXPECT_EQ(static_cast<int>(series.size()), 2 + frames);
  EXPECT_EQ(series.back().frame().frame().index(), frames - 1);
  EXPECT_EQ(exported.last.frame_count(), frames);
  EXPECT_EQ(exported.last.job_frame_count(), frames);
  EXPECT_EQ(exported.last.fraction(), 1.0);
}

TEST_F(ExportJobTest, ASmallerFileHasFewerFramesEvenlySpacedWithTheFirstAndTheLast) {
  const std::string job = finished_job();
  const Export all = export_of(job);
  const Export few = export_of(job, 1);
  ASSERT_TRUE(few.status.ok());
  EXPECT_EQ(few.last.frame_count(), 2);
  const auto between = static_cast<std::int64_t>((all.file.size() + few.file.size()) / 2);
  const Export some = export_of(job, between);
  EXPECT_LT(static_cast<double>(some.file.size()), 1.05 * static_cast<double>(between));
  std::vector<int> kept;
  for (const auto& message : answers_of<v1::StreamFramesResponse>(some.file, "StreamFrames"))
    if (message.has_frame()) kept.push_back(message.frame().frame().index());
  ASSERT_EQ(static_cast<int>(kept.size()), some.last.frame_count());
  ASSERT_GT(kept.size(), 2U);
  EXPECT_LT(some.last.frame_count(), some.last.job_frame_count());
  EXPECT_EQ(kept.front(), 0);
  EXPECT_EQ(kept.back(), some.last.job_frame_count() - 1);
  for (std::size_t i = 2; i + 1 < kept.size(); ++i) EXPECT_EQ(kept[i] - kept[i - 1], kept[1]);
}

TEST_F(ExportJobTest, ATitleCannotEndItsElementOrTheData) {
  auto submitted = small_case();
  submitted.set_title("</title></script><script>alert(1)</script><!-- & -->");
  const Export exported = export_of(finished_job(submitted));
  ASSERT_TRUE(exported.status.ok());
  EXPECT_THAT(exported.file, HasSubstr("<title>&lt;/title&gt;&lt;/script&gt;&lt;script&gt;alert(1)&lt;/script&gt;"
                                       "&lt;!-- &amp; --&gt;</title>"));
  EXPECT_EQ(exported.file.find("alert(1)</script>"), std::string::npos);
  EXPECT_EQ(answers_of<v1::Job>(exported.file, "GetJob").at(0).case_().title(), submitted.title());
}

TEST_F(ExportJobTest, OnlyAnEndedJobIsExported) {
  auto client = this->client();
  const std::string job = client.create(endless_case());
  const Export refused = export_of(job);
  EXPECT_THAT(refused.status, Fails(grpc::StatusCode::FAILED_PRECONDITION, "Wait until it has ended, or cancel it."));
  EXPECT_TRUE(client.wait_for_state(job, v1::Job::RUNNING));
  EXPECT_TRUE(client.cancel(job).ok());
  EXPECT_TRUE(client.wait_for_state(job, v1::Job::CANCELLED));
  EXPECT_TRUE(export_of(job).status.ok());
  EXPECT_EQ(export_of(job, -1).status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(export_of("jobs/99").status.error_code(), grpc::StatusCode::NOT_FOUND);
}

TEST_F(ExportJobTest, AJobCancelledWhileItWaitedIsRefused) {
  auto client = this->client();
  std::string waiting;
  for (int i = 0; i < 66; ++i) waiting = client.create(endless_case());
  EXPECT_TRUE(client.cancel(waiting).ok());
  EXPECT_THAT(export_of(waiting).status, Fails(grpc::StatusCode::FAILED_PRECONDITION, "CANCELLED before it ran"));
}

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
