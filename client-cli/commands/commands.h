#pragma once

#include <google/protobuf/map.h>

#include <CLI/App.hpp>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "command_error.h"
#include "connection/connection.h"

namespace cellcrush::client {

/// One run of the program: the common options and the chosen command.
struct Session {
  bool json = false;
  std::string server;
  CredentialFiles credentials;
  std::function<ExitCode()> action;  ///< set by the chosen command; may throw CommandError

  /// The connection to the server, opened on first use.
  Connection& connection();

 private:
  std::unique_ptr<Connection> connection_;
};

/// Adds --json, --server and the options of CredentialFiles to the program. Commands added later inherit them, so that
/// they may stand before or after the command; if repeated, the last one counts.
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

/// Adds a command that runs `action`; the caller adds its options.
CLI::App* add_command(CLI::App& app, Session& session, const std::string& name, const std::string& description,
                      std::function<ExitCode()> action);

/// Appends examples to a command's help, one command line each.
void add_examples(CLI::App& command, const std::vector<std::string>& examples);

/// The CASE argument and --set, shared by several commands.
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
void add_export_command(CLI::App& app, Session& session);
void add_queue_commands(CLI::App& app, Session& session);  ///< queue, drain
void add_sweep_commands(CLI::App& app, Session& session);  ///< sweep, retry
void add_converge_command(CLI::App& app, Session& session);
void add_table_command(CLI::App& app, Session& session);
void add_shell_commands(CLI::App& app, Session& session);  ///< completion, man

/// Adds --priority to a command.
void add_priority_option(CLI::App& command, int& priority);

/// Adds --executor to a command. `name` stays empty without the option.
void add_executor_option(CLI::App& command, std::string& name);

/// Adds --time-limit to a command. `seconds` stays 0 without the option; `default_text` describes that default.
void add_time_limit_option(CLI::App& command, double& seconds, const std::string& default_text = "the daemon's limit");

using Labels = google::protobuf::Map<std::string, std::string>;

/// Adds --label, which may be repeated, to a command.
void add_label_option(CLI::App& command, std::vector<std::string>& labels);

/// Parses "KEY=VALUE" texts as labels. Throws CommandError (refused) for another form.
Labels parse_labels(const std::vector<std::string>& texts);

/// Whether a name from the command line is a sweep's: "sweeps/NAME".
bool names_sweep(const std::string& name);

/// A job's full name: "jobs/NAME" for a NAME without a slash. Throws CommandError (refused) for a sweep's name.
std::string job_name(const std::string& name);

/// A sweep's full name: "sweeps/NAME" for a NAME without a slash. Throws CommandError (refused) for a job's name.
std::string sweep_name(const std::string& name);

}  // namespace cellcrush::client
