// Commands, options, files, fields, presets and variables that the pages name exist.
#include "docs/names.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "docs/commands.h"
#include "e2e/process.h"

namespace cellcrush::docs {
namespace {

using testing::Contains;
using testing::ElementsAre;

std::string help_of(std::vector<std::string> command) {
  command.emplace_back("--help");
  const e2e::Outcome outcome = e2e::run(command, std::chrono::seconds(30));
  EXPECT_EQ(outcome.exit_code, 0) << command[0] << outcome.all();
  return outcome.output;
}

ProgramHelp read_program(const std::string& path) {
  const std::string text = help_of({path});
  ProgramHelp help{options_of(text), {}};
  for (const std::string& command : commands_of(text)) help.commands[command] = options_of(help_of({path, command}));
  return help;
}

std::map<std::string, ProgramHelp> read_programs() {
  std::map<std::string, ProgramHelp> programs{{"cellcrush", read_program(CELLCRUSH_PROGRAM)},
                                              {"cellcrushd", read_program(CELLCRUSHD_PROGRAM)}};
  const std::filesystem::path root = CELLCRUSH_SOURCE_ROOT;
  programs.at("cellcrushd").commands["worker"] = {};  // hidden from the help: the daemon starts its workers with it
  for (const char* name :
       {"quickstart", "test", "lint", "bench", "work-precision", "compare-commits", "install-packages"}) {
    const std::string script = std::string("deploy/") + name;
    programs[script] = {options_of(help_of({(root / script).string()})), {}};
  }
  return programs;
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

TEST(PagesName, FilesThatExist) {
  const Findings findings = check_paths(CELLCRUSH_SOURCE_ROOT, pages());
  EXPECT_TRUE(findings.empty()) << to_text(findings);
}

TEST(PagesName, FieldsThatExist) {
  const Findings findings = check_fields(pages());
  EXPECT_TRUE(findings.empty()) << to_text(findings);
}

TEST(PagesName, PresetsThatExist) {
  const Findings findings = check_presets(pages());
  EXPECT_TRUE(findings.empty()) << to_text(findings);
}

TEST(PagesName, VariablesThatExist) {
  const Findings findings = check_variables(CELLCRUSH_SOURCE_ROOT, pages());
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
