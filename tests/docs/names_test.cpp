// Commands, options, files, fields, presets and variables that the pages name exist.
#include "docs/names.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "docs/commands.h"
#include "e2e/process.h"

namespace cellcrush::docs {
namespace {

using testing::Contains;
using testing::ElementsAre;

std::map<std::string, ProgramHelp> read_programs() {
  std::map<std::string, ProgramHelp> programs{{"cellcrush", e2e::read_help(CELLCRUSH_PROGRAM)},
                                              {"cellcrushd", e2e::read_help(CELLCRUSHD_PROGRAM)}};
  const std::filesystem::path root = CELLCRUSH_SOURCE_ROOT;
  programs.at("cellcrushd").commands["worker"] = {};  // hidden from the help: the daemon starts its workers with it
  for (const char* name :
       {"quickstart", "test", "lint", "bench", "work-precision", "compare-commits", "install-packages"}) {
    const std::string script = std::string("deploy/") + name;
    programs[script] = {e2e::options_of(e2e::help_of({(root / script).string()})), {}};
  }
  return programs;
}

TEST(CommandsPage, IsWhatTheProgramGenerates) {
  const std::filesystem::path path = std::filesystem::path(CELLCRUSH_SOURCE_ROOT) / "client-cli/commands.md";
  const std::string made = e2e::run({CELLCRUSH_PROGRAM, "man", "--markdown"}, std::chrono::seconds(30)).output;
  if (std::getenv("CELLCRUSH_WRITE_PAGES") != nullptr) std::ofstream(path, std::ios::binary) << made;
  EXPECT_TRUE(read_text(path) == made) << path << " is out of date: run this test with CELLCRUSH_WRITE_PAGES=1";
  for (const auto& [command, options] : e2e::read_help(CELLCRUSH_PROGRAM).commands)
    EXPECT_THAT(made, testing::HasSubstr("\n### " + command + "\n"));
}

const std::vector<Page>& pages() {
  static const std::vector<Page> kPages = read_pages(CELLCRUSH_SOURCE_ROOT);
  return kPages;
}

TEST(PagesName, CommandsAndOptionsThatExist) {
  const std::map<std::string, ProgramHelp> programs = read_programs();
  EXPECT_GT(programs.at("cellcrush").commands.size(), 15U);
  EXPECT_THAT(programs.at("cellcrush").commands.at("submit"), Contains("--set"));
  EXPECT_THAT(programs.at("cellcrushd").options, Contains("--workers"));
  EXPECT_THAT(programs.at("cellcrushd").commands, Contains(testing::Key("backup")));
  EXPECT_THAT(programs.at("deploy/quickstart").options, Contains("--small"));
  const Findings findings = check_commands(programs, pages());
  EXPECT_TRUE(findings.empty()) << to_text(findings);
}

TEST(PagesName, FilesFieldsPresetsAndVariablesThatExist) {
  for (const Findings& findings : {check_paths(CELLCRUSH_SOURCE_ROOT, pages()), check_fields(pages()),
                                   check_presets(pages()), check_variables(CELLCRUSH_SOURCE_ROOT, pages())})
    EXPECT_TRUE(findings.empty()) << to_text(findings);
}

// Each check finds what was planted, and nothing beside it.
TEST(PagesName, WhatDoesNotExistIsFound) {
  const ProgramHelp program{{"--server"}, {{"submit", {"--set", "--watch", "-o"}}, {"list", {}}}};
  const Page page = parse_page(
      "page.md",
      "`cellcrush sumbit` `cellcrush submit CASE --wach` `cellcrush COMMAND --server A` `--gone`\n"
      "```console\n$ A=b cellcrush list --watch | jq . # cellcrush gone\ncellcrush gone\n"
      "$ x=$(cellcrush submit my.txtpb \\\n    --sett a --set loading.sped=1)\n```\n"
      "```textproto\ncellcrush gone\n```\n"
      "`core/gone.h` `core/include/cellcrush/scene.{h,gone}` `core/inc*` `loading.sped` `loading.end_strain`\n"
      "`preset:type-i` `preset:type-z` `CELLCRUSH_SIMD` `CELLCRUSH_"
      "GONE`\n");
  EXPECT_THAT(
      check_commands({{"cellcrush", program}}, {page}),
      ElementsAre("page.md:3: cellcrush list has no option --watch", "page.md:5: cellcrush submit has no option --sett",
                  "page.md:1: cellcrush has no command sumbit", "page.md:1: cellcrush submit has no option --wach",
                  "page.md:1: no program has the option --gone"));
  EXPECT_THAT(check_paths(CELLCRUSH_SOURCE_ROOT, {page}), ElementsAre("page.md:11: core/gone.h does not exist"));
  EXPECT_THAT(check_presets({page}), ElementsAre("page.md:12: no preset is called type-z"));
  EXPECT_THAT(check_fields({page}), ElementsAre("page.md:6: a case has no field loading.sped",
                                                "page.md:11: a case has no field loading.sped"));
  EXPECT_THAT(check_variables(CELLCRUSH_SOURCE_ROOT, {page}),
              ElementsAre("page.md:12: nothing reads the variable CELLCRUSH_"
                          "GONE"));
}

}  // namespace
}  // namespace cellcrush::docs
