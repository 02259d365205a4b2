#include "terminal/progress_text.h"

#include <gtest/gtest.h>

#include "expect_text.h"
#include "programs/text_proto.h"
#include "terminal/table.h"

namespace cellcrush::client {
namespace {

using cellcrush::testing::from_text;

JobView running_view() {
  const auto event = from_text<v1::JobEvent>(R"(snapshot { job {
    name: "jobs/a" state: RUNNING words { plates: true }
    progress { fraction: 0.473 strain: 0.378 stress_impact_mpa: 3.4123 stress_support_mpa: 0.447
               plateau_so_far_mpa: 3.381 steps_per_second: 431.2 seconds_left: 63 } } })");
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
  testing::expect_parts_in(
      all, {"47.3 %", "1 min 03 s left", "strain 0.378", "3.412 MPa", "0.447 MPa", "3.381 MPa", "431 steps/s"});
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
  JobView view;
  view.apply(from_text<v1::JobEvent>("snapshot { job { name: 'jobs/a' state: PENDING } }"));
  EXPECT_EQ(progress_line(view), "jobs/a  PENDING: waiting for a worker");
  EXPECT_EQ(progress_lines(view, 80, {}).front(), "waiting for a worker");
}

TEST(Progress, OfAJobThatHasSucceededIsWhole) {
  JobView view;
  view.apply(from_text<v1::JobEvent>("snapshot { job { name: 'jobs/a' state: SUCCEEDED } }"));
  view.apply(from_text<v1::JobEvent>("progress { fraction: 0.99 }"));
  EXPECT_EQ(view.progress().fraction(), 1.0);
}

TEST(Progress, SamplesAndStatesKeepWhatIsKnown) {
  JobView view = running_view();
  view.apply(from_text<v1::JobEvent>("sample { strain: 0.4 stress_impact_mpa: 5 }"));
  view.apply(from_text<v1::JobEvent>("state { name: 'jobs/a' state: CANCELLING }"));
  EXPECT_EQ(view.progress().strain(), 0.4);
  EXPECT_EQ(view.progress().stress_impact_mpa(), 5.0);
  EXPECT_EQ(view.progress().plateau_so_far_mpa(), 3.381);
  EXPECT_EQ(view.job().state(), v1::Job::CANCELLING);
}

}  // namespace
}  // namespace cellcrush::client
