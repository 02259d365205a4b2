// Commands, options, files, fields, presets and variables that the pages name exist.
#include <gmock/gmock.h>
#include <google/protobuf/descriptor.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "cellcrush/v1/case.pb.h"
#include "docs/commands.h"
#include "docs/links.h"
#include "docs/page.h"
#include "programs/process.h"
#include "scenes/presets.h"

namespace cellcrush::docs {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;

namespace fs = std::filesystem;

// Calls `found` for each match in the code of a page, with its line: of blocks too when `blocks` is true.
void for_each_match(const Page& page, const std::regex& pattern, bool blocks,
                    const std::function<void(int, const std::string&)>& found) {
  const auto search = [&](int line, const std::string& text) {
    for (auto match = std::sregex_iterator(text.begin(), text.end(), pattern); match != std::sregex_iterator();
         ++match) {
      found(line, (*match)[1].str());
    }
  };
  for (const Code& code : page.inline_codes) search(code.line, code.text);
  if (!blocks) return;
  for (const Code& block : page.blocks) {
    std::istringstream lines(block.text);
    std::string line;
    for (int number = block.line; std::getline(lines, line); ++number) search(number, line);
  }
}

// Whether an entry of the folder begins with `name`.
bool has_entry_like(const fs::path& folder, const std::string& name) {
  if (!fs::is_directory(folder)) return false;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.path().filename().string().starts_with(name)) return true;
  }
  return false;
}

bool is_field_of_case(const std::string& path) {
  const google::protobuf::Descriptor* message = v1::Case::descriptor();
  std::istringstream names(path);
  std::string name;
  while (std::getline(names, name, '.')) {
    if (message == nullptr) return false;
    name = name.substr(0, name.find('['));
    const google::protobuf::FieldDescriptor* field = message->FindFieldByName(name);
    if (field == nullptr) return false;
    message = field->message_type();
  }
  return true;
}

std::set<std::string> variables_in(const fs::path& root) {
  static const std::regex kVariable("CELLCRUSH_[A-Z][A-Z_]*");
  std::set<std::string> variables;
  for (const char* folder : {"client-cli", "server", "core", "tests", "deploy", "CMakeLists.txt"}) {
    std::vector<fs::path> files;
    if (fs::is_regular_file(root / folder)) files.push_back(root / folder);
    if (fs::is_directory(root / folder)) {
      for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder)) {
        if (entry.is_regular_file() && entry.path().extension() != ".md" && entry.file_size() < 1'000'000) {
          files.push_back(entry.path());
        }
      }
    }
    for (const fs::path& path : files) {
      const std::string all = read_text(path);
      for (auto match = std::sregex_iterator(all.begin(), all.end(), kVariable); match != std::sregex_iterator();
           ++match) {
        variables.insert(match->str());
      }
    }
  }
  return variables;
}

// Paths of the tree that stand between backticks (`core/step/ledger.h`, `tests/bench`) and lead nowhere. A path ends
// before a colon or blank; one with `*`, `{` or letters for others (`jobs/JOB`) is held to the part before them.
// Fields of a case (`loading.speed_m_per_s`, between backticks or behind --set and --over) that case.proto does not
// have.
// `preset:NAME` in the pages of which there is no preset.
// Variables of the environment (CELLCRUSH_...) in the pages that stand in no source of the tree.
Findings check_paths(const fs::path& root, const std::vector<Page>& pages) {
  static const std::regex kPath(R"(^((?:core|server|client-cli|proto|tests|deploy)/[A-Za-z0-9_./-]*)(?:[*{: ].*)?$)");
  Findings findings;
  for (const Page& page : pages) {
    for (const Code& code : page.inline_codes) {
      std::smatch match;
      if (!std::regex_match(code.text, match, kPath)) continue;
      fs::path path(match[1].str());
      const bool open = code.text.size() > path.string().size() && code.text[path.string().size()] != ' ' &&
                        code.text[path.string().size()] != ':';
      if (fs::exists(root / path) || (open && path.string().ends_with('/') && fs::is_directory(root / path))) continue;
      if (open && has_entry_like(root / path.parent_path(), path.filename().string())) continue;
      findings.push_back(place_of(page, code.line) + path.string() + " does not exist");
    }
  }
  return findings;
}

Findings check_fields(const std::vector<Page>& pages) {
  static const std::regex kAlone(R"(^([a-z_0-9]+(?:\.[a-z_0-9\[\]]+)+)(?:[ =:].*)?$)");
  static const std::regex kGiven(R"(--(?:set|over)[ =]([a-z_0-9]+(?:\.[a-z_0-9\[\]]+)+)=)");
  Findings findings;
  for (const Page& page : pages) {
    const auto check = [&](int line, const std::string& path) {
      if (!is_field_of_case(path)) findings.push_back(place_of(page, line) + "a case has no field " + path);
    };
    for_each_match(page, kGiven, true, check);
    for_each_match(page, kAlone, false, [&](int line, const std::string& path) {
      if (is_field_of_case(path.substr(0, path.find('.')))) check(line, path);
    });
  }
  return findings;
}

Findings check_presets(const std::vector<Page>& pages) {
  static const std::regex kPreset("preset:([a-z0-9][a-z0-9-]*)");
  Findings findings;
  for (const Page& page : pages) {
    for_each_match(page, kPreset, true, [&](int line, const std::string& name) {
      const bool is_known = std::ranges::count(scenes::presets(), name, &scenes::NamedSpec::name) > 0;
      if (!is_known) findings.push_back(place_of(page, line) + "no preset is called " + name);
    });
  }
  return findings;
}

Findings check_variables(const fs::path& root, const std::vector<Page>& pages) {
  static const std::regex kVariable("(CELLCRUSH_[A-Z][A-Z_]*)");
  const std::set<std::string> known = variables_in(root);
  Findings findings;
  for (const Page& page : pages) {
    for_each_match(page, kVariable, true, [&](int line, const std::string& name) {
      if (!known.contains(name)) findings.push_back(place_of(page, line) + "nothing reads the variable " + name);
    });
  }
  return findings;
}

std::map<std::string, ProgramHelp> read_programs() {
  std::map<std::string, ProgramHelp> programs{{"cellcrush", e2e::read_help(CELLCRUSH_PROGRAM)},
                                              {"cellcrushd", e2e::read_help(CELLCRUSHD_PROGRAM)}};
  const std::filesystem::path root = CELLCRUSH_SOURCE_ROOT;
  programs.at("cellcrushd").commands["worker"] = {};  // hidden from the help: the daemon starts its workers with it
  for (const char* name : {"quickstart", "test", "lint", "bench", "evidence", "compare-commits", "install-packages",
                           "package", "release", "observe/start"}) {
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
    EXPECT_THAT(made, ::testing::HasSubstr("\n### " + command + "\n"));
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
  EXPECT_THAT(programs.at("cellcrushd").commands, Contains(::testing::Key("backup")));
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
