#include "help/completion.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>
#include <string_view>
#include <vector>

#include "help/case_manual.h"
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

std::string joined(const std::vector<std::string>& words) { return fmt::format("{}", fmt::join(words, " ")); }

// One line per option: names with the same words together.
std::string bash_values(const CLI::App& app) {
  std::string text;
  std::set<std::string> seen;
  const auto add = [&](const CLI::App& one) {
    for (const OptionEntry& option : option_entries(one)) {
      if (option.value.empty() || !seen.insert(option.names.back()).second) continue;
      text += fmt::format("    {}) {} ;;\n", fmt::join(option.names, "|"),
                          option.words.empty() ? "return" : "words='" + joined(option.words) + "'");
    }
  };
  add(app);
  for (const CLI::App* command : visible_commands(app)) add(*command);
  return text;
}

std::string zsh_values(const std::vector<std::string>& words) {
  if (words.empty()) return "_files";
  return words.front().ends_with('=') ? "_cellcrush_fields" : "(" + joined(words) + ")";
}

// The specifications of _arguments, one per line.
std::string zsh_options(const CLI::App& app, std::string_view indent) {
  std::string text;
  for (const OptionEntry& option : option_entries(app)) {
    const std::string description = with_backslashes(option.description, "[]:\\");
    for (const std::string& name : option.names) {
      const std::string value = option.value.empty() ? "" : ":" + option.value + ":" + zsh_values(option.words);
      const std::string specification =
          fmt::format("{}{}[{}]{}", option.repeatable ? "*" : "", name, description, value);
      text += fmt::format("{}{}\n", indent, in_single_quotes(specification));
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
    if (!option.value.empty()) text += option.words.empty() ? " -r" : " -x -a '" + joined(option.words) + "'";
    text += fmt::format(" -d '{}'\n", with_backslashes(option.description, "\\'"));
  }
  return text;
}

}  // namespace

std::string bash_completion(const CLI::App& app) {
  const std::vector<std::string> commands = command_names(app);
  std::string options;
  std::string arguments;
  for (const CLI::App* command : visible_commands(app)) {
    options += fmt::format("        {}) words+=' {}' ;;\n", command->get_name(), all_option_names(*command));
    const ArgumentWords known = argument_words(*command);
    if (known.words.empty()) continue;
    arguments += fmt::format("        {}) words='{}'{} ;;\n", command->get_name(), joined(known.words),
                             known.files ? " files=1" : "");
  }
  return fmt::format(R"(# bash completion for cellcrush
_cellcrush() {{
  COMPREPLY=()
  local words= files= command= i word=${{COMP_WORDS[COMP_CWORD]}}
  for ((i = 1; i < COMP_CWORD; ++i)); do
    case ${{COMP_WORDS[i]}} in
      {0}) command=${{COMP_WORDS[i]}}; break ;;
    esac
  done
  # bash splits words at colons.
  i=$COMP_CWORD
  if [[ $word == : && $i -gt 1 ]]; then
    word=${{COMP_WORDS[--i]}}:
  elif [[ $i -gt 2 && ${{COMP_WORDS[i - 1]}} == : ]]; then
    word=${{COMP_WORDS[i - 2]}}:$word
    ((i -= 2))
  fi
  case ${{COMP_WORDS[i - 1]}} in
{1}    *)
      if [[ $word == -* ]]; then
        words='{2}'
        case $command in
{3}        esac
      else
        case $command in
        '') words='{4}' ;;
{5}        esac
      fi
      ;;
  esac
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
  [[ ${{#COMPREPLY[@]}} -gt 0 ]] || return
  [[ -z $files ]] || mapfile -t -O ${{#COMPREPLY[@]}} COMPREPLY < <(compgen -f -- "$word")
  [[ ${{COMPREPLY[0]}} != *[=/] ]] || compopt -o nospace 2> /dev/null
  [[ $word != *:* || $COMP_WORDBREAKS != *:* ]] || COMPREPLY=("${{COMPREPLY[@]#"${{word%"${{word##*:}}"}}"}}")
}}
complete -o default -F _cellcrush cellcrush
)",
                     fmt::join(commands, "|"), bash_values(app), all_option_names(app), options,
                     fmt::join(commands, " "), arguments);
}

std::string zsh_completion(const CLI::App& app) {
  std::string commands;
  std::string cases;
  for (const CLI::App* command : visible_commands(app)) {
    const ArgumentWords known = argument_words(*command);
    commands += fmt::format("    {}\n", in_single_quotes(command->get_name() + ":" + command->get_description()));
    cases += fmt::format(
        "        {})\n          words_of_argument=({})\n          files={}\n          options=(\n{}"
        "          )\n          ;;\n",
        command->get_name(), joined(known.words), known.files || known.words.empty() ? 1 : 0,
        zsh_options(*command, "            "));
  }
  const std::vector<std::string> fields = case_paths();
  return fmt::format(R"(#compdef cellcrush
_cellcrush_fields() {{
  compadd -S '=' -- {0}
}}
_cellcrush_argument() {{
  local word
  for word in $words_of_argument; do
    if [[ $word == */ ]]; then compadd -S '' -- $word; else compadd -- $word; fi
  done
  (( files )) && _files
}}
_cellcrush() {{
  local -a commands shared options words_of_argument
  local state files=1
  commands=(
{1}  )
  shared=(
{2}  )
  _arguments -C $shared '1: :->command' '*:: :->arguments'
  case $state in
    command) _describe command commands ;;
    arguments)
      case $words[1] in
{3}      esac
      _arguments $shared $options '*:argument:_cellcrush_argument'
      ;;
  esac
}}
_cellcrush "$@"
)",
                     fmt::join(fields, " "), commands, zsh_options(app, "    "), cases);
}

std::string fish_completion(const CLI::App& app) {
  std::string text = "# fish completion for cellcrush\n" + fish_options(app, "");
  for (const CLI::App* command : visible_commands(app)) {
    const std::string condition = fmt::format(" -n '__fish_seen_subcommand_from {}'", command->get_name());
    text += fmt::format("complete -c cellcrush -n __fish_use_subcommand -f -a {} -d '{}'\n", command->get_name(),
                        with_backslashes(command->get_description(), "\\'"));
    const ArgumentWords known = argument_words(*command);
    if (!known.words.empty())
      text +=
          fmt::format("complete -c cellcrush{}{} -a '{}'\n", condition, known.files ? "" : " -f", joined(known.words));
    text += fish_options(*command, condition);
  }
  return text;
}

}  // namespace cellcrush::client
