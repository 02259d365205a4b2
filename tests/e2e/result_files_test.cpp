// Commands that take results of `cellcrush run` as they take jobs.
#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "e2e/daemon_test.h"

namespace cellcrush::e2e {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class ResultFiles : public DaemonTest {
 protected:
  void SetUp() override {
    DaemonTest::SetUp();
    const std::string submitted = write_file("small.txtpb", small_case());
    for (const auto& [name, speed] : {std::pair("fast", "100"), std::pair("slow", "50")}) {
      const Outcome outcome = program(
          {"run", submitted, "--set", std::string("loading.speed_m_per_s=") + speed, "-o", (folder() / name).string()});
      ASSERT_EQ(outcome.exit_code, 0) << outcome.all();
    }
  }

  // In the temporary folder, without a server.
  [[nodiscard]] Outcome program(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"/usr/bin/env", "-C", folder().string(), CELLCRUSH_PROGRAM});
    return run(arguments, kCrushLimit);
  }
  [[nodiscard]] std::string text_of(const char* name) const {
    std::ifstream file(folder() / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
};

TEST_F(ResultFiles, AreDrawnTabulatedExportedAndFetchedWithoutADaemon) {
  EXPECT_EQ(program({"plot", "fast", "slow/result.h5", "-o", "both.svg"}).exit_code, 0);
  EXPECT_THAT(text_of("both.svg"), HasSubstr("<svg"));
  EXPECT_EQ(program({"plot", "fast/", "--strip", "3", "-o", "strip.png"}).exit_code, 0);
  const Outcome table = program({"table", "fast", "slow/result.h5", "--csv"});
  EXPECT_EQ(table.exit_code, 0) << table.all();
  EXPECT_THAT(table.output, AllOf(HasSubstr("loading.speed_m_per_s,job,state"), HasSubstr("100,fast,SUCCEEDED"),
                                  HasSubstr("50,slow/result.h5,SUCCEEDED")));
  EXPECT_EQ(program({"movie", "fast", "--frames", "frames"}).exit_code, 0);
  EXPECT_TRUE(fs::exists(folder() / "frames/frame_00004.png"));
  EXPECT_EQ(program({"export", "fast", "-o", "fast.html"}).exit_code, 0);
  EXPECT_EQ(program({"fetch", "slow", "-o", "copy", "--frame", "0"}).exit_code, 0);
  for (const char* name : {"result.h5", "history.csv", "case.txtpb"})
    EXPECT_EQ(text_of((std::string("copy/") + name).c_str()), text_of((std::string("slow/") + name).c_str())) << name;
}

TEST_F(ResultFiles, HaveTheSummaryOfTheirJob) {
  ASSERT_EQ(cellcrush({"submit", (folder() / "small.txtpb").string(), "--watch"}, kCrushLimit).exit_code, 0);
  ASSERT_EQ(cellcrush({"fetch", "jobs/1", "-o", (folder() / "fetched").string()}).exit_code, 0);
  auto of_job = nlohmann::json::parse(cellcrush({"show", "jobs/1", "--json"}).output);
  auto of_file = nlohmann::json::parse(program({"show", "fetched", "--json"}).output);
  EXPECT_EQ(of_file["name"], "fetched");
  // Absent from files of earlier versions.
  for (auto* job : {&of_job, &of_file}) (*job)["summary"]["theory"].erase("densification_strain");
  for (const char* field : {"summary", "case", "words", "state"}) EXPECT_EQ(of_file[field], of_job[field]) << field;
}

TEST_F(ResultFiles, ThatCannotBeReadAreNamedWithTheRemedy) {
  fs::create_directory(folder() / "empty");
  std::ofstream(folder() / "text.h5") << "text";
  const Outcome refused = program({"plot", "fast", "empty", "text.h5", "absent.h5", "-o", "x.svg"});
  EXPECT_EQ(refused.exit_code, 2) << refused.all();
  EXPECT_THAT(refused.errors,
              AllOf(HasSubstr("empty: this folder has no result.h5"), HasSubstr("text.h5: not a result"),
                    HasSubstr("absent.h5: no such file"), Not(HasSubstr("fast"))));
  const Outcome mixed = program({"plot", "jobs/1", "fast", "-o", "x.svg"});
  EXPECT_EQ(mixed.exit_code, 2);
  EXPECT_THAT(mixed.errors, HasSubstr("`cellcrush fetch jobs/1 -o FOLDER`"));
  const Outcome of_server = cellcrush({"plot", (folder() / "fast").string(), "-o", (folder() / "x.svg").string()});
  EXPECT_EQ(of_server.exit_code, 2);
  EXPECT_THAT(of_server.errors, HasSubstr("Leave --server out"));
  EXPECT_FALSE(fs::exists(folder() / "x.svg"));
}

}  // namespace
}  // namespace cellcrush::e2e
