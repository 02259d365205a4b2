#pragma once

#include <CLI/App.hpp>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "connection/connection.h"
#include "exit_code.h"

namespace cellcrush::client {

/// What one run of the program is about: the options every command has, and the command that was given.
struct Session {
  bool json = false;
  std::string server;
  CredentialFiles credentials;
  std::function<ExitCode()> action;  ///< set by the command that the arguments name; may throw CommandError

  /// The server's connection, made on first use.
  Connection& connection();

 private:
  std::unique_ptr<Connection> connection_;
};

/// Adds --json, --server and the options of CredentialFiles to the program. Commands that are added later take them as
/// well, so that they may stand before and after the command; of one given twice the last counts.
void add_shared_options(CLI::App& app, Session& session);

/// Groups of commands, as the main help shows them.
constexpr const char* kCaseCommands = "Cases";
constexpr const char* kJobCommands = "Jobs and sweeps";
constexpr const char* kResultCommands = "Results";
constexpr const char* kServerCommands = "Server";

/// Groups of options, as the help of commands shows them.
constexpr const char* kCaseOptions = "Case";
constexpr const char* kIdentityOptions = "Identity";
constexpr const char* kScheduleOptions = "Scheduling";
constexpr const char* kOutputOptions = "Output";
constexpr const char* kSelectionOptions = "Selection";

/// Adds a command, which runs `action` on the options that the caller adds to it.
CLI::App* add_command(CLI::App& app, Session& session, const std::string& name, const std::string& description,
                      std::function<ExitCode()> action);

/// Puts examples, a command line each, at the end of a command's help.
void add_examples(CLI::App& command, const std::vector<std::string>& examples);

/// CASE and --set, as several commands have them.
struct CaseOptions {
  std::string source;
  std::vector<std::string> assignments;
};
void add_case_options(CLI::App& command, CaseOptions& options);

void add_case_commands(CLI::App& app, Session& session);  ///< presets, check
void add_explain_command(CLI::App& app, Session& session);
void add_show_command(CLI::App& app, Session& session);
void add_run_command(CLI::App& app, Session& session);
void add_submit_command(CLI::App& app, Session& session);
void add_watch_command(CLI::App& app, Session& session);
void add_list_command(CLI::App& app, Session& session);
void add_job_commands(CLI::App& app, Session& session);  ///< cancel, suspend, resume
void add_delete_command(CLI::App& app, Session& session);
void add_fetch_command(CLI::App& app, Session& session);
void add_plot_command(CLI::App& app, Session& session);
void add_movie_command(CLI::App& app, Session& session);
void add_queue_commands(CLI::App& app, Session& session);  ///< queue, drain
void add_sweep_commands(CLI::App& app, Session& session);  ///< sweep, retry
void add_table_command(CLI::App& app, Session& session);
void add_shell_commands(CLI::App& app, Session& session);  ///< completion, man

}  // namespace cellcrush::client
