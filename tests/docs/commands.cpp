#include "docs/commands.h"

#include <algorithm>
#include <regex>
#include <sstream>
#include <string_view>

namespace cellcrush::docs {
namespace {

// Languages of blocks whose lines are commands; of a console's, those behind a dollar.
bool is_shell(const std::string& language) { return language == "sh" || language == "bash" || language == "shell"; }

// The command lines of a block, continued lines in one, each with its line in the page.
std::vector<Code> command_lines(const Code& block) {
  std::vector<Code> out;
  std::istringstream lines(block.text);
  std::string line;
  bool continued = false;
  for (int number = block.line; std::getline(lines, line); ++number) {
    const bool starts = is_shell(block.language) || line.starts_with("$ ");
    if (continued) {
      out.back().text += line;
    } else if (starts) {
      out.push_back({number, "", line.starts_with("$ ") ? line.substr(2) : line, "", ""});
    } else {
      continue;
    }
    continued = out.back().text.ends_with('\\');
    if (continued) out.back().text.back() = ' ';
  }
  return out;
}

// Splits a shell line into words without quotes; what separates commands is a word of its own.
std::vector<std::string> words_of(const std::string& line) {
  std::vector<std::string> words;
  std::string word;
  char quote = 0;
  const auto flush = [&] {
    if (!word.empty()) words.push_back(word);
    word.clear();
  };
  for (const char letter : line) {
    if (quote != 0) {
      if (letter == quote) {
        quote = 0;
      } else {
        word += letter;
      }
    } else if (letter == '"' || letter == '\'') {
      quote = letter;
    } else if (letter == '#' && word.empty()) {
      break;
    } else if (std::string_view("|;&()<>`").find(letter) != std::string_view::npos) {
      if (!word.ends_with('$')) flush();
      word.clear();
      words.push_back(std::string(1, letter));
    } else if (letter == ' ' || letter == '\t') {
      flush();
    } else {
      word += letter;
    }
  }
  flush();
  return words;
}

bool is_separator(const std::string& word) {
  return word.size() == 1 && std::string_view("|;&()<>`").find(word[0]) != std::string_view::npos;
}

bool is_program(const std::string& word) {
  static const std::regex kProgram("cellcrushd?|deploy/([a-z]+/)?[a-z-]+");
  return std::regex_match(word, kProgram);
}

void add_mentions(const Code& code, std::vector<Mention>& mentions) {
  const std::vector<std::string> words = words_of(code.text);
  for (std::size_t i = 0; i < words.size(); ++i) {
    std::string name = words[i];
    const std::size_t folder = name.rfind("bin/");
    if (folder != std::string::npos) name.erase(0, folder + 4);
    // A program's name counts where a command begins; before it may stand assignments and few other programs.
    const bool first = i == 0 || is_separator(words[i - 1]) || words[i - 1] == "sudo" || words[i - 1] == "exec" ||
                       words[i - 1].find('=') != std::string::npos || words[i - 1] == "srun" || words[i - 1] == "do";
    if (!first || !is_program(name)) continue;
    Mention mention{code.line, name, {}};
    while (i + 1 < words.size() && !is_separator(words[i + 1])) mention.words.push_back(words[++i]);
    mentions.push_back(std::move(mention));
  }
}

// "--speed" of "[--speed=V]"; empty for what is no option.
std::string option_of(std::string word) {
  while (word.starts_with('[')) word.erase(0, 1);
  static const std::regex kOption("(--?[a-zA-Z][a-zA-Z0-9-]*).*");
  std::smatch match;
  return std::regex_match(word, match, kOption) ? match[1].str() : "";
}

// A word that stands for others: CASE, jobs/JOB, ..., [OPTIONS].
bool is_placeholder(const std::string& word) {
  static const std::regex kPlaceholder(R"(\[?\.\.\.\]?|\[?[A-Z][A-Z_-]+\]?)");
  return std::regex_match(word, kPlaceholder);
}

void check_mention(const ProgramHelp& help, const Page& page, const Mention& mention, Findings& findings) {
  const auto command =
      std::ranges::find_if(mention.words, [&](const std::string& word) { return help.commands.contains(word); });
  if (command == mention.words.end() && !help.commands.empty() && !mention.words.empty()) {
    const std::string& first = mention.words.front();
    if (option_of(first).empty() && !is_placeholder(first)) {
      findings.push_back(place_of(page, mention.line) + mention.program + " has no command " + first);
      return;
    }
  }
  for (const std::string& word : mention.words) {
    const std::string option = option_of(word);
    if (option.empty() || help.options.contains(option)) continue;
    if (command != mention.words.end() && help.commands.at(*command).contains(option)) continue;
    std::string name = mention.program;
    if (command != mention.words.end()) name.append(" ").append(*command);
    findings.push_back(place_of(page, mention.line).append(name).append(" has no option ").append(option));
  }
}

// An option alone between backticks: any program's, or one of the programs that tests and builds call.
void check_option(const std::map<std::string, ProgramHelp>& programs, const Page& page, const Code& code,
                  Findings& findings) {
  static const std::regex kForeign(
      "--(gtest|benchmark)_.*|--preset|--install|--build|--prefix|--user|--now|--array.*|--cpus-per-task.*");
  std::istringstream words(code.text);
  std::string word;
  words >> word;
  const std::string option = option_of(word);
  if (!option.starts_with("--") || std::regex_match(word, kForeign)) return;
  const bool known = std::ranges::any_of(programs, [&](const auto& program) { return program.second.has(option); });
  if (!known) findings.push_back(place_of(page, code.line) + "no program has the option " + option);
}

}  // namespace

std::vector<Mention> mentions_of(const Page& page) {
  std::vector<Mention> mentions;
  for (const Code& block : page.blocks) {
    for (const Code& line : command_lines(block)) add_mentions(line, mentions);
  }
  for (const Code& code : page.inline_codes) add_mentions(code, mentions);
  return mentions;
}

Findings check_commands(const std::map<std::string, ProgramHelp>& programs, const std::vector<Page>& pages) {
  Findings findings;
  for (const Page& page : pages) {
    for (const Mention& mention : mentions_of(page)) {
      const auto program = programs.find(mention.program);
      if (program == programs.end()) {
        findings.push_back(place_of(page, mention.line) + "no program " + mention.program);
      } else {
        check_mention(program->second, page, mention, findings);
      }
    }
    for (const Code& code : page.inline_codes) check_option(programs, page, code, findings);
  }
  return findings;
}

}  // namespace cellcrush::docs
