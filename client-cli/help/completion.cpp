#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <set>
#include <string_view>
#include <vector>

#include "case_file/field_names.h"
#include "help/shell_files.h"
#include "usage/command_entries.h"

namespace cellcrush::client {

namespace {

// The server's presets, for completion without a server; a test compares them with `cellcrush presets`.
constexpr std::array kPresetNames = {
    "hexagon-small",     "papka-kyriakides-1", "papka-kyriakides-2",    "type-i",
    "type-ii-as-stated", "type-ii-as-counted", "type-iii-as-stated",    "type-iii-as-counted",
    "inclusions-0",      "inclusions-2",       "inclusions-6",          "ruan-2003",
    "zheng-2005",        "ajdari-2011-graded", "gibson-1982-reentrant", "struck-block",
    "thrown-block",      "pressure-pulse",     "dropped-weight",        "loaded-and-unloaded",
    "brittle-lattice",   "tension-test",       "voce-hardening",        "thick-hexagons",
    "measured-ring"};

// The values of an option, or prefixes if they end in "="; empty: a file.
std::vector<std::string> words_of(const OptionEntry& option) {
  if (option.names.back() != "--set" && option.names.back() != "--over") return option.words;
  std::vector<std::string> words;
  const std::vector<std::string> paths = case_paths();
  for (std::size_t i = 0; i < paths.size(); ++i) {
    // A group precedes its fields.
    const bool is_group = i + 1 < paths.size() && paths[i + 1].starts_with(paths[i] + '.');
    if (!is_group) words.push_back(paths[i] + '=');
  }
  return words;
}

// Possible arguments of a command, as far as known without a server.
struct ArgumentWords {
  std::vector<std::string> words;  ///< presets, fields of the case, or prefixes of names if they end in "/"
  bool files = false;              ///< or a file
};

ArgumentWords argument_words(const CLI::App& command) {
  ArgumentWords out;
  for (const CLI::Option* option : command.get_options([](const CLI::Option* o) { return o->get_positional(); })) {
    const std::string& text = option->get_description();
    const auto names = [&text](const char* part) { return text.find(part) != std::string::npos; };
    if (names("preset:NAME")) {
      for (const char* name : kPresetNames) out.words.push_back(std::string("preset:") + name);
    }
    if (option->get_name(true) == "PATH") {
      const auto paths = case_paths();
      out.words.insert(out.words.end(), paths.begin(), paths.end());
    }
    if (option->get_name(true) == "CASE") {
      out.files = true;
      continue;
    }
    if (names("job") || names("Job")) out.words.emplace_back("jobs/");
    if (names("sweep")) out.words.emplace_back("sweeps/");
  }
  return out;
}

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
      const std::vector<std::string> words = words_of(option);
      text += fmt::format("    {}) {} ;;\n", fmt::join(option.names, "|"),
                          words.empty() ? "return" : "words='" + joined(words) + "'");
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
      const std::string value = option.value.empty() ? "" : ":" + option.value + ":" + zsh_values(words_of(option));
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
    const std::vector<std::string> words = words_of(option);
    if (!option.value.empty()) text += words.empty() ? " -r" : " -x -a '" + joined(words) + "'";
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
  local words= files= names= command= i word=${{COMP_WORDS[COMP_CWORD]}}
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
  # The names of jobs and sweeps are the server's, if it answers.
  if [[ $words == *s/ ]]; then
    while IFS=$'\t' read -r i _; do
      [[ " $words" != *" ${{i%/*}}/"* ]] || names+=" $i"
    done < <("${{COMP_WORDS[0]}}" completion names 2> /dev/null)
    if [[ -n $names ]]; then words=${{words/jobs\//}} words=${{words/sweeps\//}}$names; fi
  fi
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
  return fmt::format(R"zsh(#compdef cellcrush
_cellcrush_fields() {{
  compadd -S '=' -- {0}
}}
_cellcrush_argument() {{
  local word
  local -a names=(${{(f)"$(cellcrush completion names 2> /dev/null)"}}) found
  for word in $words_of_argument; do
    found=(${{(M)names:#$word*}})
    if [[ $word != */ ]]; then compadd -- $word
    elif (( $#found )); then compadd -l -V $word -d found -- ${{found%%$'\t'*}}
    else compadd -S '' -- $word; fi
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
)zsh",
                     fmt::join(fields, " "), commands, zsh_options(app, "    "), cases);
}

std::string fish_completion(const CLI::App& app) {
  std::string text = R"(# fish completion for cellcrush
function __cellcrush_names
  set -l names (cellcrush completion names 2> /dev/null)
  for kind in $argv
    printf '%s\n' $names | string match "$kind*"; or echo $kind
  end
end
)" + fish_options(app, "");
  for (const CLI::App* command : visible_commands(app)) {
    const std::string condition = fmt::format(" -n '__fish_seen_subcommand_from {}'", command->get_name());
    text += fmt::format("complete -c cellcrush -n __fish_use_subcommand -f -a {} -d '{}'\n", command->get_name(),
                        with_backslashes(command->get_description(), "\\'"));
    ArgumentWords known = argument_words(*command);
    for (std::string& word : known.words) {
      if (word.ends_with('/')) word = fmt::format("(__cellcrush_names {})", word);
    }
    if (!known.words.empty())
      text +=
          fmt::format("complete -c cellcrush{}{} -a '{}'\n", condition, known.files ? "" : " -f", joined(known.words));
    text += fish_options(*command, condition);
  }
  return text;
}

}  // namespace cellcrush::client
