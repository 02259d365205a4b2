#include "docs/shown_page.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>

#include "docs/session.h"
#include "e2e/process.h"
#include "server/temporary_folder.h"

namespace cellcrush::docs {
namespace {

namespace fs = std::filesystem;
using testing::TemporaryFolder;

constexpr std::chrono::seconds kSessionLimit{240};

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

void expect_shown(const std::string& path) {
  const TemporaryFolder folder;
  install(folder.path() / "prefix");
  const std::vector<Step> steps = steps_of(find_page(path));
  ASSERT_FALSE(steps.empty());
  const fs::path home = folder.path() / "home";
  fs::create_directories(home);
  fs::create_directory_symlink(CELLCRUSH_SOURCE_ROOT, home / "cellcrush");
  const std::vector<StepOutcome> outcomes = run_session(steps, home, folder.path() / "prefix/bin", kSessionLimit);
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const std::string place = path + ":" + std::to_string(steps[i].line) + ": $ " + steps[i].command;
    EXPECT_EQ(outcomes[i].exit_code, 0) << place << "\n" << outcomes[i].output;
    EXPECT_EQ(missing_line(steps[i].shown, outcomes[i].output), "") << place << "\n" << outcomes[i].output;
  }
  ASSERT_EQ(outcomes.size(), steps.size())
      << path << ":" << steps[std::min(outcomes.size(), steps.size() - 1)].line << ": the session ended here";
}

}  // namespace cellcrush::docs
