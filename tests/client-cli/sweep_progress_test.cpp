#include "terminal/sweep_progress.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "programs/text_proto.h"
#include "sweep_samples.h"

namespace cellcrush::client {
namespace {

using cellcrush::testing::from_text;
using ::testing::HasSubstr;
using testing::make_job;

SweepView make_view(int jobs) {
  SweepView view;
  v1::WatchSweepResponse snapshot;
  snapshot.mutable_snapshot()->set_name("sweeps/3");
  snapshot.mutable_snapshot()->add_axes()->set_field("loading.speed_m_per_s");
  for (int i = 1; i <= jobs; ++i) snapshot.mutable_snapshot()->add_jobs("jobs/" + std::to_string(i));
  view.apply(snapshot);
  for (int i = 1; i < jobs; ++i) {
    v1::WatchSweepResponse response;
    response.set_job("jobs/" + std::to_string(i));
    const v1::Job::State state = i == 1 ? v1::Job::SUCCEEDED : i == jobs - 1 ? v1::Job::RUNNING : v1::Job::PENDING;
    *response.mutable_event()->mutable_state() = make_job(i, state, 50.0 * i);
    view.apply(response);
  }
  return view;
}

TEST(SweepProgress, HasARowAJobWithValuesStateStrainAndPlateau) {
  const Terminal terminal{true, false, true};
  const auto lines = sweep_progress_lines(make_view(4), 100, 24, terminal);
  ASSERT_EQ(lines.size(), 8U);
  EXPECT_EQ(lines[0], "sweeps/3  1 of 4 jobs ended, 1 RUNNING, 2 PENDING");
  EXPECT_THAT(lines[2], HasSubstr("speed  state"));
  EXPECT_EQ(lines[4], "   50  SUCCEEDED  100.0 %     3.39    0.31  jobs/1");
  EXPECT_EQ(lines[6], "  150  RUNNING     47.3 %     3.39    0.31  jobs/3");
  EXPECT_EQ(lines[7], "       PENDING                              jobs/4");
}

TEST(SweepProgress, FitsItsTerminal) {
  const Terminal terminal{true, false, true};
  for (const int jobs : {1, 3, 40}) {
    for (const int width : {20, 40, 79, 100, 200}) {
      const auto lines = sweep_progress_lines(make_view(jobs), width, 10, terminal);
      EXPECT_LE(lines.size(), 10U);
      for (const std::string& line : lines) EXPECT_LE(display_width(line), width) << line;
    }
  }
  const auto lines = sweep_progress_lines(make_view(40), 100, 10, terminal);
  EXPECT_EQ(lines.back(), "... and 35 more jobs");
  EXPECT_TRUE(std::any_of(lines.begin(), lines.end(), [](const auto& line) {
    return line.find("RUNNING  ") != std::string::npos;
  })) << "the running job is among those that are shown";
}

TEST(SweepProgress, HasOneBarAndTheTimeLeftOfTheWholeSweep) {
  SweepView view = make_view(4);
  view.apply(from_text<v1::WatchSweepResponse>(R"(
    job: "jobs/3" event { progress { fraction: 0.5 step_count: 1000 steps_per_second: 10 seconds_left: 50 } })"));
  // 50 s of the running job, and 100 s for each of the two that wait.
  ASSERT_TRUE(view.seconds_left().has_value());
  EXPECT_NEAR(*view.seconds_left(), 250.0, 1e-9);
  EXPECT_NEAR(view.fraction(), 0.375, 1e-9);
  const auto lines = sweep_progress_lines(view, 60, 24, {});
  EXPECT_EQ(lines[1], "[############....................]  37.5 %  4 min 10 s left");
  EXPECT_EQ(std::count_if(lines.begin(), lines.end(), [](const auto& line) { return line.find('#') != line.npos; }), 1);
}

TEST(SweepProgress, ShowsEveryDigitOfWhatIsVaried) {
  SweepView view;
  for (const char* message :
       {R"(job: "jobs/1" event { state { name: "jobs/1" case { lattice { hexagon { wall_thickness_mm: 0.123456 }}}}})",
        R"(job: "jobs/2" event { state { name: "jobs/2" case { lattice { hexagon { wall_thickness_mm: 0.123457 }}}}})",
        R"(snapshot { axes { field: "lattice.hexagon.wall_thickness_mm" } jobs: ["jobs/1", "jobs/2"] })"})
    view.apply(from_text<v1::WatchSweepResponse>(message));
  const auto lines = sweep_progress_lines(view, 79, 24, {});
  EXPECT_THAT(lines[4], HasSubstr("0.123456"));
  EXPECT_THAT(lines[5], HasSubstr("0.123457"));
}

TEST(SweepProgress, InALogIsOneLine) {
  const std::string line = sweep_progress_line(make_view(4));
  EXPECT_EQ(line,
            "sweeps/3  36.8 %  1 of 4 jobs ended, 1 RUNNING, 2 PENDING; speed = 150 m/s: 47.3 %, plateau 3.39 MPa");
}

// A search through all jobs for each event would take longer than a test may.
TEST(SweepView, EventsOfAHundredThousandJobsAreApplied) {
  constexpr int kJobs = 100'000;
  SweepView view;
  v1::WatchSweepResponse first;
  for (int i = 1; i <= kJobs; ++i) first.mutable_snapshot()->add_jobs("jobs/" + std::to_string(i));
  view.apply(first);
  for (int i = 1; i <= kJobs; ++i) {
    v1::WatchSweepResponse response;
    response.set_job("jobs/" + std::to_string(i));
    response.mutable_event()->mutable_state()->set_state(i % 2 == 0 ? v1::Job::SUCCEEDED : v1::Job::RUNNING);
    view.apply(response);
  }
  ASSERT_EQ(view.jobs().size(), static_cast<std::size_t>(kJobs));
  EXPECT_EQ(view.jobs().back().name, "jobs/100000");
  EXPECT_EQ(view.count_ended(), kJobs / 2);
}

}  // namespace
}  // namespace cellcrush::client
