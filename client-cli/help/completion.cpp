#include "help/completion.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>
#include <vector>

#include "help/command_entries.h"

namespace cellcrush::client {

namespace {

// `text` with a backslash before each of `characters`.
std::string with_backslashes(std::string_view text, std::string_view characters) {
  std::string out;
  for (const char character : text) {
    if (characters.find(character) != std::string_view::npos) out += '\\';
    out += character;
  }
  return out;
}

// A word in single quotes for a shell that has no escapes within them.
std::string in_single_quotes(std::string_view text) {
  std::string out = "'";
  for (const char character : text) out += character == '\'' ? std::string("'\\''") : std::string(1, character);
  return out + "'";
}

std::string all_option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const OptionEntry& option : option_entries(app))
    names.insert(names.end(), option.names.begin(), option.names.end());
  return fmt::format("{}", fmt::join(names, " "));
}

// The specifications of _arguments, a line each.
std::string zsh_options(const CLI::App& app, std::string_view indent) {
  std::string text;
  for (const OptionEntry& option : option_entries(app)) {
    const std::string description = with_backslashes(option.description, "[]:\\");
    for (const std::string& name : option.names) {
      const std::string value = option.value.empty() ? "" : ":" + option.value + ":_files";
      text += fmt::format("{}{}\n", indent,
                          in_single_quotes((option.repeatable ? "*" : "") + name + "[" + description + "]" + value));
    }
  }
  return text;
}

std::string fish_options(const CLI::App& app, const std::string& condition) {
  std::string text;
  for (const OptionEntry& option : option_entries(app)) {
    text += "complete -c cellcrush" + condition;
    for (const std::string& name : option.names) {
      text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    }
    text += fmt::format("{} -d '{}'\n", option.value.empty() ? "" : " -r", with_backslashes(option.description, "\\'"));
  }
  return text;
}

}  // namespace

std::string bash_completion(const CLI::App& app) {
  const std::vector<std::string> commands = command_names(app);
  std::string cases;
  for (const CLI::App* command : visible_commands(app)) {
    cases += fmt::format("    {}) words+=' {}' ;;\n", command->get_name(), all_option_names(*command));
  }
  return fmt::format(R"(# bash completion for cellcrush
_cellcrush() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} command= words='{}' i
  for ((i = 1; i < COMP_CWORD; ++i)); do
    case ${{COMP_WORDS[i]}} in
      {}) command=${{COMP_WORDS[i]}}; break ;;
    esac
  done
  case $command in
    '') [[ $word == -* ]] || words='{}' ;;
{}  esac
  COMPREPLY=()
  if [[ -z $command || $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
  fi
}}
complete -o default -F _cellcrush cellcrush
)",
                     all_option_names(app), fmt::join(commands, "|"), fmt::join(commands, " "), cases);
}

std::string zsh_completion(const CLI::App& app) {
  std::string commands;
  std::string cases;
  for (const CLI::App* command : visible_commands(app)) {
    commands += fmt::format("    {}\n", in_single_quotes(command->get_name() + ":" + command->get_description()));
    cases += fmt::format("        {})\n          options=(\n{}          )\n          ;;\n", command->get_name(),
                         zsh_options(*command, "            "));
  }
  return fmt::format(R"(#compdef cellcrush
_cellcrush() {{
  local -a commands shared options
  local state
  commands=(
{}  )
  shared=(
{}  )
  _arguments -C $shared '1: :->command' '*:: :->arguments'
  case $state in
    command) _describe command commands ;;
    arguments)
      case $words[1] in
{}      esac
      _arguments $shared $options '*:argument:_files'
      ;;
  esac
}}
_cellcrush "$@"
)",
                     commands, zsh_options(app, "    "), cases);
}

std::string fish_completion(const CLI::App& app) {
  std::string text = "# fish completion for cellcrush\n" + fish_options(app, "");
  for (const CLI::App* command : visible_commands(app)) {
    text += fmt::format("complete -c cellcrush -n __fish_use_subcommand -f -a {} -d '{}'\n", command->get_name(),
                        with_backslashes(command->get_description(), "\\'"));
    text += fish_options(*command, fmt::format(" -n '__fish_seen_subcommand_from {}'", command->get_name()));
  }
  return text;
}

}  // namespace cellcrush::client
