#pragma once

#include <CLI/App.hpp>
#include <functional>
#include <memory>
#include <string>

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

/// Adds a command with --json, --server and the options of CredentialFiles, which runs `action` on the options the
/// caller adds to it.
CLI::App* add_command(CLI::App& app, Session& session, const std::string& name, const std::string& description,
                      std::function<ExitCode()> action);

/// CASE and --set, as several commands have them.
struct CaseOptions {
  std::string source;
  std::vector<std::string> assignments;
};
void add_case_options(CLI::App& command, CaseOptions& options);

void add_case_commands(CLI::App& app, Session& session);  ///< presets, check
void add_show_command(CLI::App& app, Session& session);
void add_submit_command(CLI::App& app, Session& session);
void add_watch_command(CLI::App& app, Session& session);
void add_list_command(CLI::App& app, Session& session);
void add_job_commands(CLI::App& app, Session& session);  ///< cancel, suspend, resume, delete
void add_fetch_command(CLI::App& app, Session& session);
void add_plot_command(CLI::App& app, Session& session);
void add_movie_command(CLI::App& app, Session& session);
void add_queue_commands(CLI::App& app, Session& session);  ///< queue, drain
void add_sweep_commands(CLI::App& app, Session& session);  ///< sweep, retry
void add_table_command(CLI::App& app, Session& session);

}  // namespace cellcrush::client
