// Notes on jobs and sweeps, written at any time by two who do not know of each other.
#include <gmock/gmock.h>

#include "server/daemon_fixture.h"
#include "server/small_case.h"
#include "server/sweep_requests.h"

namespace cellcrush::testing {
namespace {

using Code = grpc::StatusCode;

class NoteTest : public DaemonFixture {
 protected:
  static v1::UpdateJobRequest update_of(const std::string& job, const std::vector<std::string>& paths) {
    v1::UpdateJobRequest out;
    out.mutable_job()->set_name(job);
    for (const auto& path : paths) out.mutable_update_mask()->add_paths(path);
    return out;
  }
};

TEST_F(NoteTest, StaysWithAnEndedJobAndIsPartOfItsLastEvent) {
  const std::string job = finished_job(tiny_case());
  {
    auto client = this->client();
    const auto before = client.watch(job).events;
    EXPECT_TRUE(client.annotate(job, "first\nbuckle at 12 %").ok());
    const auto after = client.watch(job).events;
    ASSERT_EQ(after.size(), before.size());
    EXPECT_EQ(after.front().snapshot().job().note(), "first\nbuckle at 12 %");
    EXPECT_EQ(after.back().sequence(), before.back().sequence());
    EXPECT_EQ(after.back().state().note(), "first\nbuckle at 12 %");
    EXPECT_EQ(after.back().state().state(), v1::Job::SUCCEEDED);
  }
  start();
  EXPECT_EQ(client().list().front().note(), "first\nbuckle at 12 %");
  EXPECT_EQ(client().watch(job).events.back().state().note(), "first\nbuckle at 12 %");
}

TEST_F(NoteTest, ComesToAWatcherOfARunningJobAndStaysToItsEnd) {
  auto client = this->client();
  const std::string job = client.create(endless_case(), v1::Job::RUNNING);
  std::vector<std::string> notes;
  const auto watched = client.watch(job, 0, false, [&](const v1::JobEvent& event) {
    if (event.has_snapshot()) {
      EXPECT_TRUE(client.annotate(job, "too slow").ok());
    }
    if (event.state().note().empty()) return;
    notes.push_back(event.state().note() + " " + v1::Job::State_Name(event.state().state()));
    if (notes.size() == 1) {
      EXPECT_TRUE(client.cancel(job).ok());
    }
  });
  EXPECT_TRUE(watched.status.ok());
  EXPECT_EQ(notes, (std::vector<std::string>{"too slow RUNNING", "too slow CANCELLING", "too slow CANCELLED"}));
}

TEST_F(NoteTest, IsGivenAtCreationToAJobOrToASweepAlone) {
  auto client = this->client();
  auto single = job_of(tiny_case());
  single.set_note("alone");
  EXPECT_EQ(client.get(client.create(single).name()).note(), "alone");
  auto request = sweep_of(tiny_case(), kSpeed, {50.0});
  request.mutable_sweep()->set_note("all");
  const auto sweep = create(client, request);
  EXPECT_EQ(get_sweep(client, sweep.name()).note(), "all");
  EXPECT_EQ(client.get(sweep.jobs(0)).note(), "");
  EXPECT_TRUE(client.annotate(sweep.name(), "", "all").ok());
  start();
  auto next = this->client();
  EXPECT_EQ(get_sweep(next, sweep.name()).note(), "");
}

TEST_F(NoteTest, ReplacesOnlyTheNoteThatTheCallerHasRead) {
  auto client = this->client();
  const auto sweep = create(client, sweep_of(tiny_case(), kSpeed, {50.0}));
  for (const std::string& name : {sweep.name(), sweep.jobs(0)}) {
    EXPECT_TRUE(client.annotate(name, "anna's").ok());
    EXPECT_TRUE(client.annotate(name, "anna's").ok()) << "A call is repeated after its answer was lost.";
    EXPECT_THAT(client.annotate(name, "bob's"), Fails(Code::ABORTED, "\"anna's\""));
    EXPECT_TRUE(client.annotate(name, "both", "anna's").ok());
    EXPECT_THAT(client.annotate(name, "", "anna's"), Fails(Code::ABORTED, "\"both\""));
  }
}

TEST_F(NoteTest, IsRefusedWithTheFieldAndTheRemedy) {
  auto client = this->client();
  const std::string job = finished_job(tiny_case());
  const auto update = [&](const std::vector<std::string>& paths) {
    return try_call(*client.jobs, &v1::Jobs::Stub::UpdateJob, update_of(job, paths));
  };
  EXPECT_THAT(update({}), Fails(Code::INVALID_ARGUMENT, "update_mask is empty. Use \"note\""));
  EXPECT_THAT(update({"note", "title"}), Fails(Code::INVALID_ARGUMENT, "update_mask has the path \"title\""));
  EXPECT_THAT(client.annotate(job, std::string(2001, 'x')), Fails(Code::INVALID_ARGUMENT, "job.note has 2001 bytes"));
  EXPECT_TRUE(client.annotate(job, std::string(2000, 'x')).ok());
  EXPECT_THAT(client.annotate(job, "a\tb"), Fails(Code::INVALID_ARGUMENT, "job.note has the control character 0x09"));
  auto request = job_of(tiny_case());
  request.set_note("\x1b[31m");
  EXPECT_THAT(client.try_to(request), Fails(Code::INVALID_ARGUMENT, "note has the control character 0x1b"));
  auto sweep = sweep_of(tiny_case(), kSpeed, {50.0});
  sweep.mutable_sweep()->set_note(std::string(2001, 'x'));
  EXPECT_THAT(client.try_to(sweep), Fails(Code::INVALID_ARGUMENT, "sweep.note has 2001 bytes"));
  EXPECT_TRUE(client.remove(job).ok());
  EXPECT_THAT(client.annotate(job, "gone"), Fails(Code::NOT_FOUND, job));
  EXPECT_THAT(client.annotate("sweeps/7", "none"), Fails(Code::NOT_FOUND, "sweeps/7"));
}

}  // namespace
}  // namespace cellcrush::testing
