// Deleting asks first, on a terminal.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fake_server.h"
#include "program.h"

namespace cellcrush::client::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Script deletable_script() {
  Script script;
  script.job = make_job(v1::Job::SUCCEEDED);
  script.changes_jobs = true;
  script.sweeps = make_sweep_script({v1::Job::SUCCEEDED, v1::Job::FAILED});
  return script;
}

TEST(Delete, AsksOnATerminalAndDeletesAfterYes) {
  const FakeServer server(deletable_script());
  Program program({"delete", "jobs/test", "--server", server.address()}, 120);
  ASSERT_TRUE(program.wait_for_output("Delete jobs/test (SUCCEEDED, Type I of the tests) and its results? [y/N] "));
  EXPECT_TRUE(server.asked().deleted.empty());
  program.type("y\n");
  const ProgramResult result = program.wait();
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_EQ(server.asked().deleted, std::vector<std::string>{"jobs/test"});
}

TEST(Delete, AnyOtherAnswerDeletesNothing) {
  const FakeServer server(deletable_script());
  for (const char* answer : {"\n", "n\n", "what?\n", "\x04"}) {
    Program program({"delete", "sweeps/test", "--server", server.address()}, 120);
    ASSERT_TRUE(program.wait_for_output("Delete sweeps/test with its 2 jobs and all results? [y/N] "));
    program.type(answer);
    const ProgramResult result = program.wait();
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.output, HasSubstr("sweeps/test was not deleted"));
  }
  EXPECT_TRUE(server.asked().sweeps.deleted.empty());
}

TEST(Delete, DoesNotAskAfterYesOrWithoutATerminal) {
  const FakeServer server(deletable_script());
  const ProgramResult yes = Program({"delete", "jobs/test", "--yes", "--server", server.address()}, 120).wait();
  EXPECT_EQ(yes.exit_code, 0);
  EXPECT_EQ(yes.output, "jobs/test deleted\r\n");
  const ProgramResult script = server.run({"delete", "sweeps/test"});
  EXPECT_EQ(script.exit_code, 0);
  EXPECT_EQ(script.output, "sweeps/test deleted\n");
  EXPECT_EQ(script.errors, "");
}

TEST(Delete, DoesNotAskAboutWhatIsNotThere) {
  const FakeServer server(deletable_script());
  const ProgramResult result = Program({"delete", "jobs/none", "--server", server.address()}, 120).wait();
  EXPECT_EQ(result.exit_code, 5);
  EXPECT_THAT(result.output, Not(HasSubstr("[y/N]")));
}

}  // namespace
}  // namespace cellcrush::client::testing
