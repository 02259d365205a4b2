// What the program says to a name that it does not know: the nearest one, and the exit code of before.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "fake_server.h"
#include "program.h"

namespace cellcrush::client::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

struct Misspelling {
  std::vector<std::string> words;
  int exit_code;
  std::string answer;
};

void expect_answers(const std::vector<Misspelling>& misspellings, const std::vector<std::string>& more = {}) {
  for (const Misspelling& misspelling : misspellings) {
    std::vector<std::string> arguments = misspelling.words;
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramResult result = run_program(arguments);
    EXPECT_EQ(result.exit_code, misspelling.exit_code) << misspelling.answer;
    EXPECT_EQ(result.output, "");
    EXPECT_THAT(result.errors, HasSubstr(misspelling.answer));
  }
}

// Knows jobs/3 and preset:type-i.
Script script_of_one_job() {
  Script script;
  script.job = make_job(v1::Job::SUCCEEDED);
  script.job.set_name("jobs/3");
  script.preset.set_name("type-i");
  return script;
}

TEST(Suggestion, OfACommandOrAnOption) {
  expect_answers({
      {{"sumbit"}, 2, "unknown command \"sumbit\"; did you mean \"submit\"?"},
      {{"sumbit", "a.txtpb", "--watch"}, 2, "unknown command \"sumbit\"; did you mean \"submit\"?"},
      {{"list", "--sever", "x"}, 2, "unknown option \"--sever\"; did you mean \"--server\"?"},
      {{"list", "--limt=3"}, 2, "unknown option \"--limt\"; did you mean \"--limit\"?"},
      {{"fetch", "jobs/3", "--ouput", "x"}, 2, "unknown option \"--ouput\"; did you mean \"--output\"?"},
      {{"show", "jobs/3", "jobs/4"}, 2, "unexpected argument \"jobs/4\""},
      {{"crushes"}, 2, "unknown command \"crushes\"\nSee `cellcrush --help`."},
  });
}

TEST(Suggestion, OfAPreset) {
  const FakeServer server(script_of_one_job());
  expect_answers({{{"show", "preset:typei"}, 5, "id you mean \"preset:type-i\"?"},
                  {{"check", "preset:typei"}, 2, "id you mean \"preset:type-i\"?"},
                  {{"show", "type-i"}, 5, "id you mean \"preset:type-i\"?"}},
                 {"--server", server.address()});
}

TEST(Suggestion, OfAJob) {
  const FakeServer server(script_of_one_job());
  expect_answers({{{"show", "job/3"}, 5, "id you mean \"jobs/3\"?"},
                  {{"show", "jobs3"}, 5, "id you mean \"jobs/3\"?"},
                  {{"watch", "job/3"}, 5, "id you mean \"jobs/3\"?"},
                  {{"fetch", "Jobs/3", "-o", server.folder() / "x"}, 5, "id you mean \"jobs/3\"?"}},
                 {"--server", server.address()});
  const ProgramResult other = server.run({"show", "jobs/4"});
  EXPECT_THAT(other.errors, Not(HasSubstr("you mean"))) << "another number is another job: ";
}

TEST(Suggestion, OfASweep) {
  Script script = script_of_one_job();
  script.sweeps.sweep.set_name("sweeps/5");
  const FakeServer server(script);
  expect_answers(
      {{{"show", "5"}, 5, "id you mean \"sweeps/5\"?"}, {{"table", "sweep/5"}, 5, "id you mean \"sweeps/5\"?"}},
      {"--server", server.address()});
}

TEST(Suggestion, OfAFieldToSetOrToVary) {
  const FakeServer server(script_of_one_job());
  for (const char* option : {"--set", "--over"}) {
    const std::string place = std::string(option) + " loading.sped_m_per_s: Loading has no field \"sped_m_per_s\"";
    expect_answers({{{"sweep", "preset:type-i", "--over", "depth_mm=4,5", option, "loading.sped_m_per_s=50"},
                     2,
                     place + "; did you mean \"speed_m_per_s\"?"}},
                   {"--server", server.address()});
    for (const auto& [word, meant] : {std::pair("speed_m_per_s", "loading.speed_m_per_s"),
                                      {"speed", "loading.speed_m_per_s"},
                                      {"loading.wall_thickness_mm", "lattice.hexagon.wall_thickness_mm"},
                                      {"yeld_stress_mpa", "material.yield_stress_mpa"}}) {
      expect_answers({{{"sweep", "preset:type-i", "--over", "depth_mm=4,5", option, std::string(word) + "=50"},
                       2,
                       "; did you mean \"" + std::string(meant) + "\"?"}},
                     {"--server", server.address()});
    }
  }
}

TEST(Suggestion, OfAFileInTheSameFolder) {
  const FakeServer server(script_of_one_job());
  const std::string file = server.folder() / "my-case.txtpb";
  std::ofstream(file) << "depth_mm: 4\n";
  const std::string token = server.folder() / "anna.token";
  std::ofstream(token) << "secret\n";
  expect_answers({{{"check", server.folder() / "mycase.txtpb"}, 2, "did you mean \"" + file + "\"?"}},
                 {"--server", server.address()});
  expect_answers({{{"list", "--token-file", server.folder() / "ana.token"}, 2, "did you mean \"" + token + "\"?"}},
                 {"--server", "127.0.0.1:1"});
}

TEST(Suggestion, IsNotTheFileItselfThatCannotBeRead) {
  const FakeServer server(script_of_one_job());
  const std::filesystem::path loop = server.folder() / "loop.txtpb";
  std::filesystem::create_symlink("loop.txtpb", loop);
  expect_answers({{{"check", loop}, 2, "loop.txtpb: cannot be read: Too many levels of symbolic links"},
                  {{"check", server.folder()}, 2, server.folder().string() + ": is a folder; give a case file"}},
                 {"--server", server.address()});
  expect_answers({{{"list", "--token-file", server.folder()}, 2, server.folder().string() + ": is a folder"}},
                 {"--server", "127.0.0.1:1"});
  EXPECT_THAT(server.run({"check", loop}).errors, Not(HasSubstr("did you mean")));
}

TEST(Suggestion, OfTheFolderThatHasTheNameOfAJob) {
  const FakeServer server(script_of_one_job());
  const auto before = std::filesystem::current_path();
  std::filesystem::create_directories(server.folder() / "jobs" / "88");
  std::filesystem::create_directory(server.folder() / "12");
  std::filesystem::current_path(server.folder());
  expect_answers({{{"show", "12"}, 5, "To read the file or folder 12, name it ./12."},
                  {{"fetch", "jobs/88", "-o", "x"}, 5, "name it ./jobs/88."},
                  {{"table", "sweeps/5", "./12"}, 2, "sweeps/5 is a sweep on a server and ./12 a file"}},
                 {"--server", server.address()});
  std::filesystem::current_path(before);
}

TEST(Suggestion, NoArgumentsAtAllPrintTheHelp) {
  const ProgramResult result = run_program({});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.output, run_program({"--help"}).output);
  EXPECT_THAT(result.output, HasSubstr("submit"));
  EXPECT_EQ(result.errors, "");
}

}  // namespace
}  // namespace cellcrush::client::testing
