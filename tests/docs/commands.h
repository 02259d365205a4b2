#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "docs/links.h"
#include "docs/page.h"

namespace cellcrush::docs {

/// What a program accepts, as its help shows it.
struct ProgramHelp {
  std::set<std::string> options;                          ///< of the program itself, with their dashes
  std::map<std::string, std::set<std::string>> commands;  ///< options of each command
};

/// The options that a help text shows, with their dashes: those at the start of an entry.
std::set<std::string> options_of(const std::string& help);

/// The commands that a help text of a whole program lists: entries without a dash behind the first blank line.
std::vector<std::string> commands_of(const std::string& help);

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
