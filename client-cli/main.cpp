#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include "command_error.h"
#include "commands/commands.h"
#include "terminal/terminal.h"
#include "usage/help_formatter.h"
#include "usage/suggestion.h"

namespace cellcrush {

extern const char* const kVersionText;  // written at every build, by server/stamp_revision.cmake

namespace client {

namespace {

constexpr int kMostHelpColumns = 100;

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
    const bool is_absent = error.code() == ExitCode::not_found || error.code() == ExitCode::no_connection;
    const std::string hint = is_absent ? file_hint(session.words) : "";
    print_error(hint.empty() ? error : CommandError(error.code(), error.message() + ' ' + hint), session.json);
    return error.code();
  } catch (const std::exception& error) {
    print_error(CommandError(ExitCode::refused, error.what()), session.json);
    return ExitCode::refused;
  }
}

// Runs the command that the arguments name; prints results on stdout and errors on stderr.
ExitCode run_command_line(int argc, char** argv) {
  // gRPC's log would mix with the output here; this program reports errors itself.
  setenv("GRPC_VERBOSITY", "NONE", 0);
  CLI::App app(
      "Simulates the in-plane crushing of honeycombs: submits cases to cellcrushd, follows the jobs and plots the "
      "results.",
      "cellcrush");
  app.set_version_flag("--version", std::string("cellcrush ") + kVersionText);
  app.require_subcommand(1);
  app.footer(kFooter);
  app.formatter(std::make_shared<HelpFormatter>(std::min(terminal_width(), kMostHelpColumns)));
  Session session;
  session.words = {argv + 1, argv + argc};
  add_shared_options(app, session);
  add_case_commands(app, session);
  add_run_command(app, session);
  add_explain_command(app, session);
  add_import_command(app, session);
  add_submit_commands(app, session);
  add_watch_command(app, session);
  add_show_commands(app, session);
  add_job_commands(app, session);
  add_fetch_command(app, session);
  add_preview_command(app, session);
    add_plot_command(app, session);
  add_movie_command(app, session);
  add_export_command(app, session);
  add_caller_commands(app, session);
  add_queue_commands(app, session);
  add_converge_command(app, session);
  add_shell_commands(app, session);
  if (argc == 1) {
    fmt::print("{}", app.help());
    return ExitCode::done;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error), ExitCode::done;
    print_error(CommandError(ExitCode::refused, usage_message(app, error)), session.json);
    return ExitCode::refused;
  }
  const ExitCode code = run_action(session);
  if (std::fflush(stdout) != 0 && code == ExitCode::done) return ExitCode::refused;
  return code;
}

}  // namespace

}  // namespace client

}  // namespace cellcrush

int main(int argc, char** argv) { return static_cast<int>(cellcrush::client::run_command_line(argc, argv)); }
