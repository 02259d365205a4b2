#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include "case_file/suggestion.h"
#include "command_error.h"
#include "commands/commands.h"
#include "help/command_entries.h"
#include "help/help_formatter.h"

namespace cellcrush::client {

namespace {

constexpr const char* kFooter =
    "--json and the connection options may stand before or after the command.\n"
    "CASE is a file (protobuf text or JSON), - for stdin, or preset:NAME.\n"
    "Exit codes: 0 success; 1 a job failed or was cancelled; 2 wrong usage, invalid case or request refused; "
    "3 no connection; 4 connection lost before the end; 5 not found; 130 interrupted by Ctrl-C (a job of the daemon "
    "continues; a run stops at a checkpoint).";

ExitCode run_action(const Session& session) {
  try {
    return session.action();
  } catch (const CommandError& error) {
    print_error(error, session.json);
    return error.code();
  } catch (const std::exception& error) {
    print_error(CommandError(ExitCode::refused, error.what()), session.json);
    return ExitCode::refused;
  }
}

void append_option_names(const CLI::App& app, std::vector<std::string>& names) {
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
}

std::string usage_message(const CLI::App& app, const CLI::App* command, const CLI::ParseError& error) {
  const std::vector<std::string> unknown = app.remaining(true);
  if (unknown.empty()) return command == nullptr ? "no command given" : error.what();
  const std::string word = unknown.front().substr(0, unknown.front().find('='));
  if (word.starts_with('-')) {
    std::vector<std::string> names;
    if (command != nullptr) append_option_names(*command, names);
    append_option_names(app, names);
    return with_suggestion(fmt::format("unknown option \"{}\"", word), find_nearest(word, names));
  }
  if (command != nullptr) return fmt::format("unexpected argument \"{}\"", unknown.front());
  return with_suggestion(fmt::format("unknown command \"{}\"", word), find_nearest(word, command_names(app)));
}

// The error for arguments that `app` could not parse: an unknown command or option with the nearest existing one, else
// the parser's message, and where to find help.
CommandError usage_error(const CLI::App& app, const CLI::ParseError& error) {
  const std::vector<CLI::App*> given = app.get_subcommands();
  const CLI::App* command = given.empty() ? nullptr : given.front();
  const std::string help =
      command == nullptr ? "cellcrush --help" : fmt::format("cellcrush {} --help", command->get_name());
  return {ExitCode::refused, fmt::format("{}\nSee `{}`.", usage_message(app, command, error), help)};
}

// Runs the command that the arguments name; prints results on stdout and errors on stderr.
ExitCode run_command_line(int argc, char** argv) {
  // gRPC's log would mix with the output here; this program reports errors itself.
  setenv("GRPC_VERBOSITY", "NONE", 0);
  CLI::App app(
      "Simulates the in-plane crushing of honeycombs: submits cases to cellcrushd, follows the jobs and plots the "
      "results.",
      "cellcrush");
  app.set_version_flag("--version", std::string("cellcrush " CELLCRUSH_VERSION));
  app.require_subcommand(1);
  app.footer(kFooter);
  app.formatter(std::make_shared<HelpFormatter>());
  Session session;
  add_shared_options(app, session);
  add_case_commands(app, session);
  add_run_command(app, session);
  add_explain_command(app, session);
  add_submit_command(app, session);
  add_watch_command(app, session);
  add_show_command(app, session);
  add_list_command(app, session);
  add_job_commands(app, session);
  add_delete_command(app, session);
  add_fetch_command(app, session);
  add_plot_command(app, session);
  add_movie_command(app, session);
  add_export_command(app, session);
  add_queue_commands(app, session);
  add_sweep_commands(app, session);
  add_converge_command(app, session);
  add_table_command(app, session);
  add_shell_commands(app, session);
  if (argc == 1) {
    fmt::print("{}", app.help());
    return ExitCode::done;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error), ExitCode::done;
    print_error(usage_error(app, error), session.json);
    return ExitCode::refused;
  }
  const ExitCode code = run_action(session);
  if (std::fflush(stdout) != 0 && code == ExitCode::done) return ExitCode::refused;
  return code;
}

}  // namespace

}  // namespace cellcrush::client

int main(int argc, char** argv) { return static_cast<int>(cellcrush::client::run_command_line(argc, argv)); }
