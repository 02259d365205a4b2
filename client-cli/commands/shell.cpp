// Files that packages install, generated from the parser's definition. An empty group hides these commands from the
// help.
#include <fmt/format.h>

#include "commands/commands.h"
#include "help/shell_files.h"
#include "terminal/sweep_text.h"
#include "terminal/terminal.h"
#include "usage/man_page.h"

namespace cellcrush::client {

namespace {

const ManPage kManPage = {.section = 1,
                          .manual = "User Commands",
                          .version = CELLCRUSH_VERSION,
                          .summary = "simulate the in-plane crushing of honeycombs",
                          .synopsis = "[OPTIONS] COMMAND ...",
                          .see_also = "cellcrushd (8)"};

std::string completion_script(const CLI::App& app, const std::string& shell) {
  if (shell == "bash") return bash_completion(app);
  return shell == "zsh" ? zsh_completion(app) : fish_completion(app);
}

// What the scripts offer of a server: its newest jobs and sweeps, a line each, what describes one behind a tab.
void print_names(Connection& connection) {
  constexpr std::chrono::seconds kTyping{2};
  const auto jobs = connection.call(connection.jobs(), &v1::Jobs::Stub::ListJobs, v1::ListJobsRequest(), kTyping);
  for (const v1::Job& job : jobs.jobs())
    fmt::print("{}\t{} {}\n", job.name(), v1::Job::State_Name(job.state()), printable(job.case_().title()));
  const auto sweeps =
      connection.call(connection.sweeps(), &v1::Sweeps::Stub::ListSweeps, v1::ListSweepsRequest(), kTyping);
  for (const v1::Sweep& sweep : sweeps.sweeps())
    fmt::print("{}\t{} {}\n", sweep.name(), job_count_text(sweep.jobs_size()), printable(sweep.case_().title()));
}

}  // namespace

void add_shell_commands(CLI::App& app, Session& session) {
  const auto shell = std::make_shared<std::string>();
  CLI::App* completion =
      add_command(app, session, "", "completion", "Print the completion script of a shell", [&app, &session, shell] {
        *shell == "names" ? print_names(session.connection()) : fmt::print("{}", completion_script(app, *shell));
        return ExitCode::done;
      });
  completion
      ->add_option("SHELL", *shell, "bash, zsh or fish; names lists the jobs and sweeps that these scripts complete")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh", "fish", "names"}));
  const auto markdown = std::make_shared<bool>(false);
  CLI::App* man = add_command(app, session, "", "man", "Print the man page", [&app, markdown] {
    fmt::print("{}", *markdown ? command_page(app) : man_page(app, kManPage));
    return ExitCode::done;
  });
  man->add_flag("--markdown", *markdown, "Print client-cli/commands.md instead");
}

}  // namespace cellcrush::client
