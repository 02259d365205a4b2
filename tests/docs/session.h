#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "docs/page.h"

namespace cellcrush::docs {

/// A command of a console block, and the output that the page shows of it.
struct Step {
  int line = 0;  ///< of the command in the page
  std::string command;
  std::vector<std::string> shown;  ///< without empty lines; "..." for what the page leaves out
};

/// The commands of a page's console blocks, in their order; a command may be continued with a backslash.
std::vector<Step> steps_of(const Page& page);

/// A line with every number as `#`, every bar of a progress as `=`, and blanks as one: what stays the same between two
/// machines.
std::string masked(const std::string& line);

/// Whether the output has the shown lines, masked, in their order. Between two shown lines no other may stand unless
/// the page shows "...". Returns the first shown line that is missing; empty when all are there.
std::string missing_line(const std::vector<std::string>& shown, const std::string& output);

/// How one command of a session ended.
struct StepOutcome {
  int exit_code = -1;
  std::string output;  ///< both standard output and standard error
};

/// Who types a session.
enum class Reader {
  caller,
  ordinary_user,  ///< `nobody` if the caller is root, who then gives `folder` away
};

/// Types the commands into one bash, as a reader would, with `folder` as home and working directory and the programs
/// first on its PATH. A daemon that is started in the background listens on its default Unix socket only; the session
/// waits until it answers, and kills it at the end. Returns an outcome for each command that was reached.
std::vector<StepOutcome> run_session(const std::vector<Step>& steps, const std::filesystem::path& folder,
                                     const std::filesystem::path& programs, std::chrono::seconds limit,
                                     Reader reader = Reader::caller);

/// `cmake --install` of the build that the test belongs to.
void install(const std::filesystem::path& prefix);

/// Types the console blocks of a page of the tree, after an installation in ~/.local, in a home of their own, which has
/// the tree as ~/cellcrush, and expects of each command what the page shows. `instead` has words of the page, and what
/// is typed instead of each; `saved` has files that the reader saves first, each with the language of the page's block
/// that stands in it.
void expect_shown(const std::string& path, Reader reader = Reader::caller,
                  const std::map<std::string, std::string>& instead = {},
                  const std::map<std::string, std::string>& saved = {});

}  // namespace cellcrush::docs
