#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <fstream>

#include "house/house_rules.h"
#include "house/source_lines.h"

namespace cellcrush::house {
namespace {

namespace fs = std::filesystem;

TEST(House, NoArrowOfThisTreeTurns) {
  const std::vector<Violation> violations = check_house(CELLCRUSH_SOURCE_ROOT);
  EXPECT_TRUE(violations.empty()) << to_text(violations);
}

TEST(House, TheCheckReadsTheFilesOfThisTree) {
  const fs::path root = CELLCRUSH_SOURCE_ROOT;
  const std::vector<IncludeLine> includes = read_includes(root / "core/include/cellcrush/simulation.h");
  ASSERT_FALSE(includes.empty());
  EXPECT_EQ(resolve_include(root, "core/include/cellcrush/simulation.h", "cellcrush/vector.h"),
            "core/include/cellcrush/vector.h");
}

// A small tree in which every arrow stands right, and in which one can be turned.
class PlantedTree : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "cellcrush-house-XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    root_ = pattern;
    write("CMakeLists.txt", "");
    write("core/include/cellcrush/scene.h", "#pragma once\n#include <vector>\n");
    write("core/include/cellcrush/run.h", "#pragma once\n#include \"cellcrush/scene.h\"\n");
    write("core/step/advance.h", "#pragma once\n#include <Eigen/Core>\n#include \"cellcrush/run.h\"\n");
    write("core/step/advance.cpp", "#include \"step/advance.h\"\n#include <cmath>\n");
    write("server/store/journal.h", "#pragma once\n#include <sqlite3.h>\n");
    write("server/translate/case.cpp", "#include \"cellcrush/scene.h\"\n#include \"cellcrush/v1/case.pb.h\"\n");
    write("server/worker/run.cpp", "#include \"cellcrush/run.h\"\n#include \"store/journal.h\"\n");
    write("client-cli/connection/pages.h", "#pragma once\n");
    write("client-cli/usage/man_page.h", "#pragma once\n");
    write("client-cli/drawing/drawing.h", "#pragma once\n");
    write("server/main.cpp", "#include \"drawing/drawing.h\"\n#include \"usage/man_page.h\"\n");
    write("client-cli/main.cpp", "#include <CLI/CLI.hpp>\n#include \"cellcrush/v1/case.pb.h\"\n");
    write("tests/core/helper.h", "#pragma once\n#include \"step/advance.h\"\n");
    write("tests/server/case_test.cpp", "#include \"cellcrush/scene.h\"\n#include \"cellcrush/v1/case.pb.h\"\n");
  }

  void TearDown() override { fs::remove_all(root_); }

  void write(const std::string& file, const std::string& text) const {
    fs::create_directories((root_ / file).parent_path());
    std::ofstream(root_ / file) << text;
  }

  // Plants `include` as line 3 of a file and expects that the check names that line, and nothing else.
  void expect_found(const std::string& file, const std::string& include, const std::string& rule) const {
    const std::string before = file.ends_with(".h") ? "#pragma once\n\n" : "// A file.\n\n";
    write(file, before + "#include " + include + "\n");
    const std::vector<Violation> violations = check_house(root_);
    ASSERT_EQ(violations.size(), 1U) << to_text(violations);
    EXPECT_EQ(violations[0].file, file);
    EXPECT_EQ(violations[0].line, 3);
    EXPECT_NE(violations[0].rule.find(rule), std::string::npos) << violations[0].rule;
  }

  fs::path root_;
};

TEST_F(PlantedTree, WithoutAPlantIsClean) { EXPECT_EQ(to_text(check_house(root_)), ""); }

TEST_F(PlantedTree, WhatAFolderMayNotIncludeIsFound) {
  const std::vector<std::array<std::string, 3>> plants = {
      {"core/step/bad.cpp", "\"store/journal.h\"", "core includes nothing outside core"},
      {"core/step/bad.cpp", "\"../../server/store/journal.h\"", "core includes nothing outside core"},
      {"core/step/bad.cpp", "\"cellcrush/v1/case.pb.h\"", "core includes nothing outside core"},
      {"core/step/bad.h", "<hdf5.h>", "core includes nothing outside core"},
      {"core/step/bad.cpp", "<chrono>", "core knows no clock and no files"},
      {"core/include/cellcrush/bad.h", "<hwy/highway.h>", "core includes nothing outside core"},
      {"core/include/cellcrush/bad.h", "<spdlog/spdlog.h>", "core includes nothing outside core"},
      {"core/include/cellcrush/bad.h", "\"step/advance.h\"", "core/include takes only"},
      {"server/worker/bad.cpp", "\"step/advance.h\"", "server includes no header of core but"},
      {"server/worker/bad.cpp", "\"connection/pages.h\"", "server includes no header of client-cli but"},
      {"proto/columns/bad.cpp", "\"connection/pages.h\"", "proto includes nothing outside proto"},
      {"client-cli/bad.cpp", "<cellcrush/scene.h>", "client-cli includes no header of core or server"},
      {"client-cli/bad.cpp", "\"store/journal.h\"", "client-cli includes no header of core or server"},
      {"server/worker/bad.cpp", "\"cellcrush/scene.h\"\n#include \"cellcrush/v1/case.pb.h\"",
       "only server/translate joins"},
      {"server/worker/bad.cpp", "\"tests/core/helper.h\"", "nobody but tests includes tests"},
      {"tests/core/reference/bad.cpp", "\"cellcrush/scene.h\"", "the oracle shares nothing with core"},
  };
  for (const auto& [file, include, rule] : plants) {
    SCOPED_TRACE(file + " includes " + include);
    expect_found(file, include, rule);
    fs::remove(root_ / file);
  }
}

TEST_F(PlantedTree, FoldersOfCoreMayNotIncludeEachOther) {
  write("core/beam/element.h", "#pragma once\n");
  write("core/step/loads.cpp", "#include \"beam/element.h\"\n");
  expect_found("core/beam/bad.cpp", "\"step/advance.h\"",
               "core/beam -> core/step -> core/beam, by\n  core/beam/bad.cpp:3\n  core/step/loads.cpp:1");
}

TEST_F(PlantedTree, FoldersOfServerMayNotIncludeEachOtherAlongOthers) {
  write("server/worker/run.h", "#pragma once\n");
  write("server/translate/spec.h", "#pragma once\n#include \"worker/run.h\"\n");
  write("server/translate/more.cpp", "#include \"worker/run.h\"\n");
  expect_found("server/store/bad.cpp", "\"translate/spec.h\"",
               "server/store -> server/translate -> server/worker -> server/store, by\n  server/store/bad.cpp:3\n"
               "  server/translate/more.cpp:1\n  server/translate/spec.h:2\n  server/worker/run.cpp:2");
}

TEST_F(PlantedTree, LinesEndWithin120Columns) {
  const std::string widest = "# " + std::string(117, 'x') + "\u00e9\n";  // a character of two bytes
  for (const std::string file : {"CMakeLists.txt", "deploy/run", "deploy/common.sh", "proto/job.proto",
                                 "server/stamp.cmake", "tests/scenes/frame.cpp", "server/page/src/main.ts"}) {
    write(file, widest + "\n" + widest);
    EXPECT_EQ(to_text(check_house(root_)), "");
    write(file, widest + "\nx" + widest);
    EXPECT_EQ(to_text(check_house(root_)), file + ":3: Lines end within 120 columns.\n");
    write(file, "");
  }
  write("tests/page.md", "x" + widest);
  EXPECT_EQ(to_text(check_house(root_)), "") << "pages have a check of their own";
}

TEST_F(PlantedTree, TheRootTakesNoOtherEntry) {
  write("tools/helper.py", "");
  const std::vector<Violation> violations = check_house(root_);
  ASSERT_EQ(violations.size(), 1U) << to_text(violations);
  EXPECT_EQ(violations[0].file, "tools");
}

}  // namespace
}  // namespace cellcrush::house
