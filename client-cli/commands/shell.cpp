// Files that packages install, generated from the parser's definition. An empty group hides these commands from the
// help.
#include <fmt/format.h>

#include "commands/commands.h"
#include "help/command_page.h"
#include "help/completion.h"
#include "help/man_page.h"

namespace cellcrush::client {

namespace {

std::string completion_script(const CLI::App& app, const std::string& shell) {
  if (shell == "bash") return bash_completion(app);
  return shell == "zsh" ? zsh_completion(app) : fish_completion(app);
}

}  // namespace

void add_shell_commands(CLI::App& app, Session& session) {
  const auto shell = std::make_shared<std::string>();
  CLI::App* completion =
      add_command(app, session, "completion", "Print the completion script of a shell", [&app, shell] {
        fmt::print("{}", completion_script(app, *shell));
        return ExitCode::done;
      });
  completion->group("");
  completion->add_option("SHELL", *shell, "bash, zsh or fish")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh", "fish"}));
  const auto markdown = std::make_shared<bool>(false);
  CLI::App* man = add_command(app, session, "man", "Print the man page", [&app, markdown] {
    fmt::print("{}", *markdown ? command_page(app) : man_page(app, CELLCRUSH_VERSION));
    return ExitCode::done;
  });
  man->group("");
  man->add_flag("--markdown", *markdown, "Print client-cli/commands.md instead");
}

}  // namespace cellcrush::client
