#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "docs/links.h"
#include "docs/page.h"
#include "programs/program_help.h"

namespace cellcrush::docs {

using e2e::ProgramHelp;

/// A command line of a page: the words behind the program's name, without quotes, up to a pipe, `;`, `&` or comment.
struct Mention {
  int line = 0;
  std::string program;  ///< "cellcrush", "cellcrushd" or "deploy/NAME"
  std::vector<std::string> words;
};

/// All command lines of a page, in its blocks (without text, output and files) and its inline code.
std::vector<Mention> mentions_of(const Page& page);

/// Commands and options of the pages that no program has. `programs` by the name they are mentioned by; mentions of a
/// program that is not among them are findings too.
Findings check_commands(const std::map<std::string, ProgramHelp>& programs, const std::vector<Page>& pages);

}  // namespace cellcrush::docs
