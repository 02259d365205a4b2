#include "terminal/output_file.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>

#include "command_error.h"

namespace cellcrush::client {
namespace {

namespace fs = std::filesystem;

class OutputFileTest : public ::testing::Test {
 protected:
  OutputFileTest() {
    std::string name = (fs::temp_directory_path() / "cellcrush-output-XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  ~OutputFileTest() override { fs::remove_all(folder_); }

  void put(const char* name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
  [[nodiscard]] std::string get(const char* name) const {
    std::ifstream file(folder_ / name);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  [[nodiscard]] std::ptrdiff_t file_count() const {
    return std::distance(fs::directory_iterator(folder_), fs::directory_iterator());
  }

  fs::path folder_;
};

TEST_F(OutputFileTest, AppearsOnlyWhenItIsComplete) {
  put("a.csv", "old");
  {
    OutputFile file(folder_ / "a.csv");
    file.write("new");
    EXPECT_EQ(get("a.csv"), "old");
    file.commit();
    EXPECT_EQ(get("a.csv"), "new");
  }
  EXPECT_EQ(file_count(), 1);
}

TEST_F(OutputFileTest, VanishesWithoutCommit) {
  put("a.csv", "old");
  { OutputFile(folder_ / "a.csv").write("new"); }
  EXPECT_EQ(get("a.csv"), "old");
  EXPECT_EQ(file_count(), 1);
}

TEST_F(OutputFileTest, FinishedItWaitsForCommit) {
  OutputFile file(folder_ / "a.csv");
  file.write("new");
  file.finish();
  EXPECT_FALSE(fs::exists(folder_ / "a.csv"));
  file.commit();
  EXPECT_EQ(get("a.csv"), "new");
}

TEST_F(OutputFileTest, AFolderThatIsNotThereIsRefused) {
  EXPECT_THROW(OutputFile(folder_ / "none" / "a.csv"), CommandError);
}

TEST_F(OutputFileTest, OnlyOwnFilesAreOverwritten) {
  put("own.csv", "time_s,strain\n1,2\n");
  put("foreign.csv", "my notes");
  fs::create_directory(folder_ / "folder.csv");
  EXPECT_NO_THROW(check_may_overwrite(folder_ / "absent.csv", {"time_s"}));
  EXPECT_NO_THROW(check_may_overwrite(folder_ / "own.csv", {"time_s"}));
  EXPECT_NO_THROW(check_may_overwrite(folder_ / "own.csv", {"an earlier form of its first line", "time_s"}));
  EXPECT_THROW(check_may_overwrite(folder_ / "foreign.csv", {"time_s"}), CommandError);
  EXPECT_THROW(check_may_overwrite(folder_ / "folder.csv", {"time_s"}), CommandError);
}

}  // namespace
}  // namespace cellcrush::client
