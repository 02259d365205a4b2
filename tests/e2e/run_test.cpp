// `cellcrush run`: a crush without a running daemon.
#include <gmock/gmock.h>

#include <csignal>
#include <fstream>
#include <iterator>

#include "e2e/daemon_test.h"

namespace cellcrush::e2e {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

// As the small case, of a second or two, so that a signal finds it under way; two signals, at half that speed.
std::string longer_case(const std::string& speed = "0.16") {
  std::string text = small_case();
  text.replace(text.find("speed_m_per_s: 100"), 18, "speed_m_per_s: " + speed);
  return text;
}

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// The process of the cellcrushd whose data folder this is; 0 for none.
int find_daemon_of(const fs::path& data) {
  for (const auto& entry : fs::directory_iterator("/proc")) {
    const std::string words = bytes_of(entry.path() / "cmdline");
    const std::string program = words.substr(0, words.find('\0'));
    const std::string option = std::string("--data") + '\0' + data.string() + '\0';
    if (program.ends_with("cellcrushd") && words.find(option) != std::string::npos)
      return std::stoi(entry.path().filename());
  }
  return 0;
}

class Run : public DaemonTest {
 protected:
  static std::vector<std::string> words(const std::string& submitted, const fs::path& output) {
    return {CELLCRUSH_PROGRAM, "run", submitted, "-o", output.string()};
  }

  // Runs a case and sends a signal once it is on its way.
  Outcome run_until(int signal, const std::vector<std::string>& command) {
    Process process(command);
    EXPECT_TRUE(process.wait_for_output("steps/s", kShortLimit)) << process.output() << process.errors();
    process.send(signal);
    return process.wait(kShortLimit);
  }

  // history.csv of the same case by the test's daemon.
  std::string history_of_the_daemon(const std::string& submitted) {
    EXPECT_EQ(cellcrush({"submit", submitted, "--watch"}, kCrushLimit).exit_code, 0);
    EXPECT_EQ(cellcrush({"fetch", "jobs/1", "-o", (folder() / "fetched").string()}).exit_code, 0);
    return bytes_of(folder() / "fetched" / "history.csv");
  }
};

TEST_F(Run, GivesTheBitsOfADaemonAndLeavesTheResultsAlone) {
  const std::string submitted = write_file("small.txtpb", small_case());
  const fs::path output = folder() / "out";
  const Outcome outcome = run(words(submitted, output), kCrushLimit);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.all();
  EXPECT_THAT(outcome.output, HasSubstr("plateau stress"));
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(output)) names.push_back(entry.path().filename());
  EXPECT_THAT(names, ::testing::UnorderedElementsAre("case.txtpb", "history.csv", "result.h5"));
  EXPECT_EQ(bytes_of(output / "history.csv"), history_of_the_daemon(submitted));
}

TEST_F(Run, HasTheForcesOfSideWallsAndGrips) {
  std::string text = small_case();
  text.replace(text.find("end_strain: 0.5"), 15, R"(end_strain: 0.05 sides { kind: RIGID friction: 0.1 }
    grips { id: "foot" edge: RIGHT fixed_to: SUPPORT_PLATE })");
  const std::string submitted = write_file("edges.txtpb", text);
  const fs::path output = folder() / "out";
  const Outcome outcome = run(words(submitted, output), kCrushLimit);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.all();
  const std::string walls = bytes_of(output / "rigid_walls.csv");
  EXPECT_THAT(walls, AllOf(HasSubstr(",side_low,0,"), HasSubstr(",side_high,0,")));
  EXPECT_THAT(bytes_of(output / "grips.csv"),
              AllOf(HasSubstr("time_s,grip,displacement_x_mm,displacement_y_mm,force_x_n,force_y_n\n"),
                    HasSubstr(",foot,0,0,-")));  // it pushes back
  const Outcome refused = cellcrush({"check", submitted, "--set", "loading.grips[0].edge=LEFT"});
  EXPECT_EQ(refused.exit_code, 2) << refused.all();
  EXPECT_THAT(refused.all(), HasSubstr("Set edge to RIGHT"));
}

TEST_F(Run, NamesAFileSystemWithoutLocks) {
  std::vector<std::string> command = {"/usr/bin/env", std::string("LD_PRELOAD=") + CELLCRUSH_NO_LOCKS,
                                      "ASAN_OPTIONS=verify_asan_link_order=0"};
  for (const auto& word : words(write_file("small.txtpb", small_case()), folder() / "out")) command.push_back(word);
  const Outcome outcome = run(command, kShortLimit);
  EXPECT_EQ(outcome.exit_code, 2) << outcome.all();
  EXPECT_THAT(outcome.errors, AllOf(HasSubstr("mounted at /"), HasSubstr("has no locks: No locks available."),
                                    HasSubstr("cellcrush run -o")));
  EXPECT_FALSE(fs::exists(folder() / "out"));
}

TEST_F(Run, StoppedBySignalsItContinuesToTheSameBits) {
  const std::string submitted = write_file("longer.txtpb", longer_case("0.08"));
  auto command = words(submitted, folder() / "out");
  const Outcome stopped = run_until(SIGINT, command);
  EXPECT_EQ(stopped.exit_code, 130) << stopped.all();
  EXPECT_THAT(stopped.errors, HasSubstr("--resume"));
  const Outcome again = run(command, kShortLimit);
  EXPECT_EQ(again.exit_code, 2) << "Nothing is begun again unasked. " << again.all();
  EXPECT_THAT(again.errors, HasSubstr("unfinished run"));
  const Outcome other =
      run({CELLCRUSH_PROGRAM, "run", write_file("small.txtpb", small_case()), "-o", command.back(), "--resume"},
          kShortLimit);
  EXPECT_EQ(other.exit_code, 2) << other.all();
  EXPECT_THAT(other.errors, HasSubstr("another case"));
  command.emplace_back("--resume");
  EXPECT_EQ(run_until(SIGTERM, command).exit_code, 130);
  const Outcome ended = run(command, kCrushLimit);
  ASSERT_EQ(ended.exit_code, 0) << ended.all();
  EXPECT_EQ(bytes_of(folder() / "out" / "history.csv"), history_of_the_daemon(submitted));
  const Outcome finished = run(command, kShortLimit);
  EXPECT_EQ(finished.exit_code, 0) << finished.all();
  EXPECT_THAT(finished.output, HasSubstr("already holds the result of this case"));
}

TEST_F(Run, KilledItContinuesToo) {
  const std::string submitted = write_file("longer.txtpb", longer_case());
  auto command = words(submitted, folder() / "out");
  EXPECT_EQ(run_until(SIGKILL, command).exit_code, 128 + SIGKILL);
  command.emplace_back("--resume");
  // Its daemon ends in order, which takes a moment in which it still holds the folder.
  Outcome ended;
  for (int i = 0; i < 20 && ended.exit_code != 0; ++i) ended = run(command, kCrushLimit);
  ASSERT_EQ(ended.exit_code, 0) << ended.all();
  EXPECT_EQ(bytes_of(folder() / "out" / "history.csv"), history_of_the_daemon(submitted));
}

TEST_F(Run, ResumedItHasTheTimeLimitOfThatCommand) {
  auto command = words(write_file("longer.txtpb", longer_case()), folder() / "out");
  command.insert(command.end(), {"--time-limit", "1h"});
  EXPECT_EQ(run_until(SIGINT, command).exit_code, 130);
  command.back() = "0.01s";
  command.emplace_back("--resume");
  const Outcome ended = run(command, kCrushLimit);
  EXPECT_EQ(ended.exit_code, 1) << ended.all();
  EXPECT_THAT(ended.output, HasSubstr("TIME_LIMIT"));
  EXPECT_THAT(ended.output, ::testing::AllOf(HasSubstr("its time limit of 0.01 s"), HasSubstr("--time-limit")));
}

TEST_F(Run, WhoseDaemonDiesSaysHowToContinue) {
  auto command = words(write_file("longer.txtpb", longer_case()), folder() / "out");
  Process process(command);
  ASSERT_TRUE(process.wait_for_output("steps/s", kShortLimit)) << process.output() << process.errors();
  const int daemon = find_daemon_of(folder() / "out" / ".cellcrush");
  ASSERT_GT(daemon, 0);
  kill(daemon, SIGKILL);
  const Outcome ended = process.wait(kCrushLimit);
  EXPECT_EQ(ended.exit_code, 4) << ended.all();
  EXPECT_THAT(ended.errors, HasSubstr("--resume continues"));
  EXPECT_THAT(ended.errors, ::testing::Not(HasSubstr("cellcrush watch")));
  command.emplace_back("--resume");
  EXPECT_EQ(run(command, kCrushLimit).exit_code, 0);
}

TEST_F(Run, OneThatFailedIsNoFinishedRun) {
  auto command = words(write_file("longer.txtpb", longer_case()), folder() / "out");
  command.insert(command.end(), {"--time-limit", "0.3s", "--resume"});
  const Outcome failed = run(command, kCrushLimit);
  EXPECT_EQ(failed.exit_code, 1) << failed.all();
  EXPECT_FALSE(fs::exists(folder() / "out" / ".cellcrush"));
  EXPECT_EQ(run(command, kCrushLimit).exit_code, 1) << "It is begun again.";
}

TEST_F(Run, ABadCaseIsRefusedAndLeavesNoUnfinishedRun) {
  const std::string bad = write_file("bad.txtpb", small_case() + "depth_mm: -1\n");
  const fs::path output = folder() / "out";
  const Outcome outcome = run(words(bad, output), kShortLimit);
  EXPECT_EQ(outcome.exit_code, 2) << outcome.all();
  EXPECT_THAT(outcome.errors, HasSubstr("depth_mm"));
  EXPECT_FALSE(fs::exists(output / ".cellcrush"));
}

}  // namespace
}  // namespace cellcrush::e2e
