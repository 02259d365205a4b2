#include <gmock/gmock.h>

#include <map>
#include <thread>

#include "server/daemon_fixture.h"
#include "server/small_case.h"
#include "server/sweep_requests.h"
#include "server/watch_contract.h"

namespace cellcrush::testing {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

/// A watch of all jobs, read by the test message by message.
class JobsWatch {
 public:
  JobsWatch(Client& client, const v1::WatchJobsRequest& request)
      : context_(bounded_context()), reader_(client.jobs->WatchJobs(context_.get(), request)) {
    v1::WatchJobsResponse first;
    if (!read(first)) return;
    EXPECT_TRUE(first.has_snapshot());
  }
  ~JobsWatch() {
    context_->TryCancel();
    if (reader_) static_cast<void>(reader_->Finish());
  }
  JobsWatch(const JobsWatch&) = delete;
  JobsWatch& operator=(const JobsWatch&) = delete;

  bool read(v1::WatchJobsResponse& out) {
    if (!reader_->Read(&out)) return false;
    if (!out.resume_token().empty()) token = out.resume_token();
    return true;
  }

  // Reads up to a message of which `is_last` is true.
  template <class IsLast>
  std::vector<v1::WatchJobsResponse> read_until(const IsLast& is_last) {
    std::vector<v1::WatchJobsResponse> out;
    while (read(out.emplace_back())) {
      if (is_last(out.back())) return out;
    }
    ADD_FAILURE() << "The watch ended: " << finish().error_message();
    out.pop_back();
    return out;
  }

  grpc::Status finish() {
    const auto status = reader_->Finish();
    reader_.reset();
    return status;
  }

  std::string token;

 private:
  std::unique_ptr<grpc::ClientContext> context_;
  std::unique_ptr<grpc::ClientReader<v1::WatchJobsResponse>> reader_;
};

class WatchJobsTest : public DaemonFixture {
 protected:
  static auto ends(const std::string& job) {
    return [job](const v1::WatchJobsResponse& message) {
      return message.job().name() == job && message.job().has_end_time();
    };
  }

  // "jobs/1 RUNNING" for each change, in order.
  static std::vector<std::string> changes_in(const std::vector<v1::WatchJobsResponse>& messages) {
    std::vector<std::string> out;
    for (const auto& message : messages) {
      if (message.has_job()) out.push_back(message.job().name() + " " + v1::Job::State_Name(message.job().state()));
      if (!message.deleted_job().empty()) out.push_back(message.deleted_job() + " deleted");
      if (message.has_sweep()) out.push_back(message.sweep().name());
      if (!message.deleted_sweep().empty()) out.push_back(message.deleted_sweep() + " deleted");
    }
    return out;
  }

  grpc::Status refusal_of(const v1::WatchJobsRequest& request) {
    auto client = this->client();
    const auto context = bounded_context();
    const auto reader = client.jobs->WatchJobs(context.get(), request);
    v1::WatchJobsResponse out;
    EXPECT_FALSE(reader->Read(&out));
    return reader->Finish();
  }
};

TEST_F(WatchJobsTest, OneStreamSaysWhatHappensToAllJobsAndSweeps) {
  auto client = this->client();
  const std::string before = client.create(tiny_case());
  EXPECT_TRUE(client.wait_for_state(before, v1::Job::SUCCEEDED));
  JobsWatch watch(client, {});
  auto titled = tiny_case();
  titled.set_title("Seven cells");
  const std::string job = client.create(titled);
  const auto first = watch.read_until(ends(job));
  const auto sweep = create(client, sweep_of(tiny_case(), kSpeed, {50.0, 100.0}));
  std::map<std::string, int> ended;
  const auto second = watch.read_until([&](const v1::WatchJobsResponse& message) {
    if (message.job().has_end_time()) ++ended[message.job().name()];
    return ended.size() == 2;
  });
  EXPECT_TRUE(client.remove(before).ok());
  const auto third = watch.read_until([](const auto& message) { return !message.deleted_job().empty(); });
  EXPECT_EQ(changes_in(first), (std::vector<std::string>{job + " PENDING", job + " RUNNING", job + " SUCCEEDED"}));
  EXPECT_EQ(first.front().job().title(), "Seven cells");
  EXPECT_EQ(first.front().job().sweep(), "");
  EXPECT_GT(first.back().job().summary().step_count(), 0);
  EXPECT_EQ(changes_in(second).at(0), sweep.name());
  EXPECT_EQ(changes_in(second).size(), 7U) << "The sweep, and three states of each of its jobs.";
  EXPECT_EQ(second.back().job().sweep(), sweep.name());
  EXPECT_THAT(changes_in(third), Contains(before + " deleted"));
}

TEST_F(WatchJobsTest, NotesAreChangesAlsoOfJobsThatHaveEnded) {
  auto client = this->client();
  const auto made = create(client, sweep_of(tiny_case(), kSpeed, {50.0}));
  const std::string ended = made.jobs(0);
  EXPECT_TRUE(client.wait_for_state(ended, v1::Job::SUCCEEDED));
  const std::string running = client.create(endless_case(), v1::Job::RUNNING);
  JobsWatch watch(client, {});
  for (const std::string& name : {ended, running, made.name()}) EXPECT_TRUE(client.annotate(name, "so far good").ok());
  const auto noted = watch.read_until([](const auto& message) { return message.has_sweep(); });
  EXPECT_EQ(changes_in(noted), (std::vector<std::string>{ended + " SUCCEEDED", running + " RUNNING", made.name()}));
  for (const auto& message : noted) {
    if (message.has_progress()) continue;
    EXPECT_EQ(message.job().note() + message.sweep().note(), "so far good");
  }
}

TEST_F(WatchJobsTest, AResumedWatchGetsEveryChangeOnce) {
  auto client = this->client();
  std::vector<std::string> seen;
  std::string token;
  const std::string job = client.create(tiny_case());
  EXPECT_TRUE(client.wait_for_state(job, v1::Job::SUCCEEDED));
  {
    JobsWatch watch(client, {});
    token = watch.token;
  }
  std::vector<std::string> jobs;
  for (int i = 0; i < 3; ++i) jobs.push_back(client.create(tiny_case()));
  for (const auto& each : jobs) EXPECT_TRUE(client.wait_for_state(each, v1::Job::SUCCEEDED));
  // One change a watch.
  for (int i = 0; i < 9; ++i) {
    v1::WatchJobsRequest request;
    request.set_resume_token(token);
    JobsWatch watch(client, request);
    const auto read = watch.read_until([](const auto& message) { return message.has_job(); });
    for (const auto& change : changes_in(read)) seen.push_back(change);
    token = watch.token;
  }
  JobsWatch whole(client, [&] {
    v1::WatchJobsRequest request;
    request.set_resume_token(token);
    return request;
  }());
  const std::string last = client.create(tiny_case());
  const auto rest = whole.read_until(ends(last));
  std::map<std::string, int> times;
  for (const auto& change : seen) ++times[change];
  EXPECT_EQ(times.size(), 9U);
  for (const auto& each : jobs) {
    for (const char* state : {" PENDING", " RUNNING", " SUCCEEDED"}) EXPECT_EQ(times[each + state], 1) << each << state;
  }
  EXPECT_EQ(changes_in(rest).at(0), last + " PENDING") << "Nothing of before comes again.";
}

TEST_F(WatchJobsTest, AFilterLeavesOtherJobsOutAndProgressOfRunningJobsComes) {
  auto client = this->client();
  v1::WatchJobsRequest request;
  request.set_filter("title : \"wanted\"");
  JobsWatch watch(client, request);
  const std::string other = client.create(endless_case());
  auto wanted = endless_case();
  wanted.set_title("The WANTED one");
  const std::string job = client.create(wanted);
  const auto read = watch.read_until([](const auto& message) { return message.has_progress(); });
  for (const auto& message : read) EXPECT_NE(message.job().name(), other);
  EXPECT_EQ(read.back().progress().job(), job);
  EXPECT_GT(read.back().progress().progress().step_count(), 0);
}

TEST_F(WatchJobsTest, ARequestedJobSendsWhatItsOwnWatchSends) {
  auto client = this->client();
  const std::string job = client.create(small_case());
  v1::WatchJobsRequest request;
  auto& wanted = *request.add_jobs();
  wanted.set_name(job);
  wanted.set_frames(true);
  wanted.set_encoding(v1::FieldFrame::PACKED);
  request.add_jobs()->set_name("jobs/99");
  JobsWatch watch(client, request);
  WatchContract contract(0);
  grpc::Status end_of_job(grpc::StatusCode::UNKNOWN, "");
  grpc::Status end_of_other;
  int frames = 0;
  int meshes = 0;
  watch.read_until([&](const v1::WatchJobsResponse& message) {
    if (message.has_watched()) {
      EXPECT_EQ(message.watched().job(), job);
      contract.see(message.watched().event());
      meshes += message.watched().event().has_mesh() ? 1 : 0;
      if (message.watched().event().has_frame()) {
        ++frames;
        EXPECT_TRUE(message.watched().event().frame().frame().has_packed());
        EXPECT_EQ(message.watched().event().frame().frame().position_mm_size(), 0);
      }
    }
    if (!message.has_watched_end()) return false;
    const auto& status = message.watched_end().status();
    auto& end = message.watched_end().job() == job ? end_of_job : end_of_other;
    end = grpc::Status(static_cast<grpc::StatusCode>(status.code()), status.message());
    return message.watched_end().job() == job;
  });
  contract.end(end_of_job);
  EXPECT_THAT(contract.broken(), ::testing::IsEmpty());
  EXPECT_TRUE(end_of_job.ok());
  EXPECT_EQ(end_of_other.error_code(), grpc::StatusCode::NOT_FOUND);
  EXPECT_EQ(meshes, 1);
  EXPECT_GT(frames, 0);
}

TEST_F(WatchJobsTest, WhatIsNotValidIsRefusedWithARemedy) {
  v1::WatchJobsRequest request;
  request.set_filter("state = RUNNING");
  EXPECT_EQ(refusal_of(request).error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  request.set_filter("owner =");
  EXPECT_EQ(refusal_of(request).error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  request.clear_filter();
  for (const char* token : {"nonsense", "@", "@-1", "@1x", "x@99999999999999999999"}) {
    request.set_resume_token(token);
    EXPECT_EQ(refusal_of(request).error_code(), grpc::StatusCode::INVALID_ARGUMENT) << token;
  }
  request.set_resume_token("another@0");
  EXPECT_EQ(refusal_of(request).error_code(), grpc::StatusCode::FAILED_PRECONDITION);
  auto client = this->client();
  std::string token;
  {
    JobsWatch watch(client, {});
    token = watch.token;
  }
  request.set_resume_token(token.substr(0, token.find('@')) + "@7");
  const auto beyond = refusal_of(request);
  EXPECT_EQ(beyond.error_code(), grpc::StatusCode::OUT_OF_RANGE);
  EXPECT_THAT(beyond.error_message(), HasSubstr("without a resume_token"));
  request.clear_resume_token();
  for (int i = 0; i < 65; ++i) request.add_jobs()->set_name("jobs/1");
  EXPECT_EQ(refusal_of(request).error_code(), grpc::StatusCode::INVALID_ARGUMENT);
}

}  // namespace
}  // namespace cellcrush::testing
