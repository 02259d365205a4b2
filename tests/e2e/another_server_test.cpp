// A command continues with the server that answered it first, or not at all.
#include <gmock/gmock.h>

#include "e2e/daemon_test.h"

namespace cellcrush::e2e {
namespace {

using ::testing::HasSubstr;

class AnotherServer : public DaemonTest {
 protected:
  // At the same address, with other data, in which jobs/1 is another job.
  void come_back_with_other_data() {
    stop_daemon();
    std::filesystem::rename(folder() / "data", folder() / "former");
    start_daemon();
    crush("SECOND");
  }

  void crush(const std::string& title) {
    const auto done = cellcrush({"submit", write_file("case", small_case()), "--set", "title=" + title, "--watch"});
    ASSERT_EQ(done.exit_code, 0) << done.all();
  }

  void expect_that_the_second_stands() const { EXPECT_THAT(cellcrush({"list"}).output, HasSubstr("SECOND")); }
};

TEST_F(AnotherServer, GetsNoAnswerToAQuestionAboutAJobOfTheFormerOne) {
  crush("FIRST");
  Process asking(command({"delete", "jobs/1"}), {}, 80);
  ASSERT_TRUE(asking.wait_for_output("Delete jobs/1 (SUCCEEDED, FIRST) and its results? [y/N] ", kShortLimit));
  come_back_with_other_data();
  asking.type("y\n");
  const auto refused = asking.wait(kShortLimit);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.output, HasSubstr("cellcrush: This is another server, or another data folder, than the one"));
  expect_that_the_second_stands();
}

TEST_F(AnotherServer, EndsAWatchThatBeganWithTheFormerOne) {
  const std::string slow = write_file("slow", small_case());
  ASSERT_EQ(cellcrush({"submit", slow, "--set", "loading.speed_m_per_s=0.1"}).exit_code, 0);
  Process watching(command({"watch", "jobs/1"}));
  ASSERT_TRUE(watching.wait_for_output("strain", kShortLimit));
  come_back_with_other_data();
  const auto lost = watching.wait(kShortLimit);
  EXPECT_EQ(lost.exit_code, 4);
  EXPECT_THAT(lost.errors, HasSubstr("cellcrush: lost the watch of jobs/1: This is another server"));
}

}  // namespace
}  // namespace cellcrush::e2e
