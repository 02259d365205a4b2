#include "terminal/progress_text.h"

#include <gtest/gtest.h>

#include "terminal/table.h"

namespace cellcrush::client {
namespace {

JobView running_view() {
  v1::JobEvent event;
  v1::Job& job = *event.mutable_snapshot()->mutable_job();
  job.set_name("jobs/a");
  job.set_state(v1::Job::RUNNING);
  job.mutable_words()->set_plates(true);
  v1::Progress& progress = *job.mutable_progress();
  progress.set_fraction(0.473);
  progress.set_strain(0.378);
  progress.set_stress_impact_mpa(3.4123);
  progress.set_stress_support_mpa(0.447);
  progress.set_plateau_so_far_mpa(3.381);
  progress.set_steps_per_second(431.2);
  progress.set_seconds_left(63);
  JobView view;
  view.apply(event);
  return view;
}

TEST(Progress, NoLineIsWiderThanTheTerminal) {
  for (const bool unicode : {false, true}) {
    for (int width = 1; width <= 240; ++width) {
      for (const std::string& line : progress_lines(running_view(), width, {false, false, unicode})) {
        EXPECT_LE(display_width(line), width) << line;
      }
    }
  }
}

TEST(Progress, AWideTerminalShowsEverythingInTwoLines) {
  const auto lines = progress_lines(running_view(), 100, {false, false, false});
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_NE(lines[0].find("  47.3 %  1 min 03 s left"), std::string::npos) << lines[0];
  EXPECT_EQ(lines[1], "strain 0.378  impact  3.412 MPa  support  0.447 MPa  plateau  3.381 MPa  431 steps/s");
}

TEST(Progress, ANarrowTerminalShowsTheSameInMoreLines) {
  std::string all;
  for (const std::string& line : progress_lines(running_view(), 40, {false, false, false}))
    all.append(line).append("\n");
  for (const char* part :
       {"47.3 %", "1 min 03 s left", "strain 0.378", "3.412 MPa", "0.447 MPa", "3.381 MPa", "431 steps/s"}) {
    EXPECT_NE(all.find(part), std::string::npos) << part << "\n" << all;
  }
}

TEST(Progress, TheBarIsAsWideAsAskedAndFillsUp) {
  const Terminal unicode{false, false, true};
  const Terminal ascii{};
  for (const double fraction : {0.0, 0.01, 0.333, 0.5, 0.999, 1.0, 7.0, -1.0}) {
    EXPECT_EQ(display_width(bar_text(fraction, 30, unicode)), 30) << fraction;
    EXPECT_EQ(display_width(bar_text(fraction, 30, ascii)), 30) << fraction;
  }
  EXPECT_EQ(bar_text(0.5, 12, ascii), "[#####.....]");
  EXPECT_EQ(bar_text(1.0, 4, unicode), "████");
  EXPECT_EQ(bar_text(0.0, 4, unicode), "░░░░");
}

TEST(Progress, APendingJobSaysThatItWaits) {
  v1::JobEvent event;
  event.mutable_snapshot()->mutable_job()->set_name("jobs/a");
  event.mutable_snapshot()->mutable_job()->set_state(v1::Job::PENDING);
  JobView view;
  view.apply(event);
  EXPECT_EQ(progress_line(view), "jobs/a  PENDING: waiting for a worker");
  EXPECT_EQ(progress_lines(view, 80, {}).front(), "waiting for a worker");
}

TEST(Progress, SamplesAndStatesKeepWhatIsKnown) {
  JobView view = running_view();
  v1::JobEvent sample;
  sample.mutable_sample()->set_strain(0.4);
  sample.mutable_sample()->set_stress_impact_mpa(5.0);
  view.apply(sample);
  v1::JobEvent state;
  state.mutable_state()->set_name("jobs/a");
  state.mutable_state()->set_state(v1::Job::CANCELLING);
  view.apply(state);
  EXPECT_EQ(view.progress().strain(), 0.4);
  EXPECT_EQ(view.progress().stress_impact_mpa(), 5.0);
  EXPECT_EQ(view.progress().plateau_so_far_mpa(), 3.381);
  EXPECT_EQ(view.job().state(), v1::Job::CANCELLING);
}

}  // namespace
}  // namespace cellcrush::client
