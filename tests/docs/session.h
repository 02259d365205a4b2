#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "docs/page.h"

namespace cellcrush::docs {

/// Something a reader types, and the output that the page shows of it.
struct Step {
  int line = 0;  ///< of the command in the page
  std::string command;
  std::vector<std::string> shown;  ///< without empty lines at the end; "..." for what the page leaves out
  int shown_line = 0;              ///< of the first shown line
};

/// What the blocks of a page ask its reader to do, in their order: the commands behind the dollars of `console`, the
/// lines of `sh`, both continued with a backslash, the commands of "run", and the files that the page has saved. The
/// other blocks of Python are one program, which runs at the end. Blocks with an excuse ask nothing.
std::vector<Step> steps_of(const Page& page);

/// How one command of a session ended.
struct StepOutcome {
  static constexpr int kPackagesAreMissing = 77;
  int exit_code = -1;
  std::string output;  ///< both standard output and standard error
};

/// Who types a session.
enum class Reader {
  caller,
  ordinary_user,  ///< `nobody` if the caller is root, who then gives `folder` away
};

/// Types the commands into one bash, as a reader would, with `folder` as home and working directory and the programs
/// first on its PATH. Ports of loopback are others, which are free. A daemon, in the background or not, takes the place
/// of the one before; the session waits until it answers, and kills it at the end. `apt-get install` only asks whether
/// the packages are there; if not, its outcome is kPackagesAreMissing, the last. Returns an outcome for each command
/// that was reached.
std::vector<StepOutcome> run_session(const std::vector<Step>& steps, const std::filesystem::path& folder,
                                     const std::filesystem::path& programs, std::chrono::seconds limit,
                                     Reader reader = Reader::caller);

/// `cmake --install` of the build that the test belongs to.
void install(const std::filesystem::path& prefix);

/// A page with other lines in place of those that its steps show: `shown` has those of the first steps.
std::string with_shown(const std::string& page, const std::vector<Step>& steps,
                       const std::vector<std::vector<std::string>>& shown);

/// Takes the steps of a page of the tree, after an installation in ~/.local, in a home of their own, which has the tree
/// as ~/cellcrush, and expects of each command what the page shows, save volatile values (shown_output.h). `instead`
/// has words of the page, and what is typed instead of each; `before` is typed first. With CELLCRUSH_WRITE_PAGES it
/// writes what the commands print into the page.
void expect_shown(const std::string& path, Reader reader = Reader::caller,
                  const std::map<std::string, std::string>& instead = {}, const std::vector<std::string>& before = {});

}  // namespace cellcrush::docs
