// The revision that is stamped at every build: of a work tree, and of a tree without a repository.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "programs/temporary_folder.h"

namespace cellcrush::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::MatchesRegex;

class RevisionTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(tree() / "core" / "step");
    std::filesystem::create_directories(tree() / "server" / "translate");
    write("core/step/step.cpp", "1");
    write("server/translate/case.cpp", "1");
    write("README.md", "1");
  }

  [[nodiscard]] std::filesystem::path tree() const { return folder_.path() / "tree"; }
  [[nodiscard]] std::filesystem::path output() const { return folder_.path() / "revision.cpp"; }

  void write(const std::string& name, const std::string& text) const { std::ofstream(tree() / name) << text; }

  // What is stamped now.
  struct Stamp {
    std::string revision;
    std::string identity;
  };
  [[nodiscard]] Stamp stamp(const std::string& build = "gcc 12 -O3") const {
    const std::string command =
        std::string(CMAKE_PROGRAM) + " -DSOURCE=" + tree().string() + " -DOUTPUT=" + output().string() +
        " -DVERSION=1.2.3 -DAPI_VERSION=4.5.6 -DRESULT_VERSION=1.1.0 -DSOLVER_VERSION=7.8.9 '-DBUILD=" + build +
        "' -DGIT=git -P " + STAMP_SCRIPT;
    EXPECT_EQ(std::system(command.c_str()), 0);
    return {value_of("kSolverRevision"), value_of("kSolverIdentity")};
  }

  [[nodiscard]] std::string value_of(const std::string& name) const {
    std::ifstream file(output());
    const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    const auto begin = text.find('"', text.find(name + " =")) + 1;
    return text.substr(begin, text.find('"', begin) - begin);
  }

  // False when there is no git here.
  [[nodiscard]] bool git(const std::string& arguments) const {
    const std::string command = "git -C " + tree().string() +
                                " -c user.name=test -c user.email=test@localhost -c init.defaultBranch=main " +
                                arguments + " >/dev/null 2>&1";
    return std::system(command.c_str()) == 0;
  }

  TemporaryFolder folder_;
};

TEST_F(RevisionTest, WithoutARepositoryTheHashOfTheSolverIsStampedAllTheSame) {
  const auto first = stamp();
  EXPECT_EQ(first.revision, "1.2.3+unknown");
  EXPECT_THAT(first.identity, MatchesRegex("7\\.8\\.9\\+core-[0-9a-f]{12}"));
  const auto written = std::filesystem::last_write_time(output());
  EXPECT_EQ(stamp().identity, first.identity);
  EXPECT_EQ(std::filesystem::last_write_time(output()), written) << "Nothing is compiled again for nothing.";
  write("README.md", "2");
  EXPECT_EQ(stamp().identity, first.identity);
  write("core/step/step.cpp", "2");
  EXPECT_NE(stamp().identity, first.identity);
  write("core/step/step.cpp", "1");
  EXPECT_EQ(stamp().identity, first.identity);
  write("server/translate/case.cpp", "2");
  EXPECT_NE(stamp().identity, first.identity);
  write("server/translate/case.cpp", "1");
  EXPECT_NE(stamp("gcc 13 -O3").identity, first.identity);
}

TEST_F(RevisionTest, AWorkTreeThatDiffersFromItsCommitIsDirtyFromTheNextBuildOn) {
  if (!git("init") || !git("add .") || !git("commit -m first")) GTEST_SKIP() << "no git";
  const auto first = stamp();
  EXPECT_THAT(first.revision, MatchesRegex("1\\.2\\.3\\+[0-9a-f]{12}"));
  write("core/step/step.cpp", "2");
  const auto changed = stamp();
  EXPECT_EQ(changed.revision, first.revision + "-dirty");
  EXPECT_NE(changed.identity, first.identity);
  ASSERT_TRUE(git("commit -am second"));
  const auto second = stamp();
  EXPECT_THAT(second.revision, MatchesRegex("1\\.2\\.3\\+[0-9a-f]{12}"));
  EXPECT_NE(second.revision, first.revision);
  EXPECT_EQ(second.identity, changed.identity);
  write("new.cpp", "1");
  EXPECT_THAT(stamp().revision, HasSubstr("-dirty"));
}

}  // namespace
}  // namespace cellcrush::testing
