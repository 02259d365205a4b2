#include "docs/shown_page.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <fstream>

#include "e2e/process.h"
#include "server/temporary_folder.h"

namespace cellcrush::docs {
namespace {

namespace fs = std::filesystem;
using testing::TemporaryFolder;

constexpr std::chrono::seconds kSessionLimit{480};

Page find_page(const std::string& path) {
  for (Page& page : read_pages(CELLCRUSH_SOURCE_ROOT)) {
    if (page.path == path) return page;
  }
  ADD_FAILURE() << "no page " << path;
  return {};
}

}  // namespace

void install(const fs::path& prefix) {
  const e2e::Outcome outcome = e2e::run(
      {CELLCRUSH_CMAKE, "--install", CELLCRUSH_BINARY_ROOT, "--prefix", prefix.string()}, std::chrono::seconds(60));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.all();
}

void expect_shown(const std::string& path, Reader reader, const std::map<std::string, std::string>& instead,
                  const std::map<std::string, std::string>& saved) {
  const TemporaryFolder folder;
  // An ordinary user passes through it.
  fs::permissions(folder.path(), fs::perms::others_exec, fs::perm_options::add);
  const fs::path home = folder.path() / "home";
  install(home / ".local");
  const Page page = find_page(path);
  for (const auto& [file, language] : saved) {
    const auto block = std::ranges::find(page.blocks, language, &Code::language);
    ASSERT_NE(block, page.blocks.end()) << path << " has no block of " << language;
    std::ofstream(home / file) << block->text;
  }
  std::vector<Step> steps = steps_of(page);
  ASSERT_FALSE(steps.empty());
  for (const auto& [words, typed] : instead) {
    const auto step = std::ranges::find_if(steps, [&page_words = words](const Step& candidate) {
      return candidate.command.find(page_words) != std::string::npos;
    });
    ASSERT_NE(step, steps.end()) << path << " has no command with " << words;
    step->command.replace(step->command.find(words), words.size(), typed);
  }
  fs::create_directory_symlink(CELLCRUSH_SOURCE_ROOT, home / "cellcrush");
  const std::vector<StepOutcome> outcomes = run_session(steps, home, home / ".local/bin", kSessionLimit, reader);
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const std::string place = path + ":" + std::to_string(steps[i].line) + ": $ " + steps[i].command;
    EXPECT_EQ(outcomes[i].exit_code, 0) << place << "\n" << outcomes[i].output;
    EXPECT_EQ(missing_line(steps[i].shown, outcomes[i].output), "") << place << "\n" << outcomes[i].output;
  }
  ASSERT_EQ(outcomes.size(), steps.size())
      << path << ":" << steps[std::min(outcomes.size(), steps.size() - 1)].line << ": the session ended here";
}

}  // namespace cellcrush::docs
