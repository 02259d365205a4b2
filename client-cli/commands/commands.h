#pragma once

#include <google/protobuf/map.h>

#include <CLI/App.hpp>
#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "case_file/case_source.h"
#include "command_error.h"
#include "connection/connection.h"

namespace cellcrush::client {

class PrivateDaemon;

/// One run of the program: the common options and the chosen command.
struct Session {
  bool json = false;
  std::string server;
  CredentialFiles credentials;
  std::vector<std::string> words;    ///< of the command line
  std::function<ExitCode()> action;  ///< set by the chosen command; may throw CommandError

  Session();
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// The connection to the server, opened on first use.
  Connection& connection();

  /// The names of these jobs on the server: "jobs/NAME" for a NAME without a slash. If they are result.h5 files, or
  /// folders of `run` or `fetch`, the server becomes a private one with a job for each. Throws CommandError (refused)
  /// for a sweep's name, for jobs together with files, and for files that are no results.
  std::vector<std::string> find_jobs(const std::vector<std::string>& names);
  std::string find_job(const std::string& name) { return find_jobs({name}).front(); }

  /// Without --server, the server becomes a private one. Throws CommandError (refused) if it does not start.
  void use_private_server();

 private:
  std::unique_ptr<PrivateDaemon> private_;
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
CLI::App* add_command(CLI::App& app, Session& session, const char* group, const std::string& name,
                      const std::string& description, std::function<ExitCode()> action);

/// The same with options, which live as long as the command; returns both.
template <typename Options, typename Run>
std::pair<CLI::App*, Options*> add_command(CLI::App& app, Session& session, const char* group, const std::string& name,
                                           const std::string& description, Run run) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = add_command(app, session, group, name, description,
                                  [&session, options, run] { return run(session, std::as_const(*options)); });
  return {command, options.get()};
}

/// Adds an option or a flag to a group of a command's options.
template <typename Value>
CLI::Option* add_option(CLI::App& command, const char* group, const std::string& names, Value& value,
                        const std::string& description) {
  if constexpr (std::is_same_v<Value, bool>) return command.add_flag(names, value, description)->group(group);
  return command.add_option(names, value, description)->group(group);
}

/// Appends examples to a command's help, one command line each.
void add_examples(CLI::App& command, const std::vector<std::string>& examples);

/// Adds the CASE argument, --lattice with the options of a drawing, and --set.
void add_case_options(CLI::App& command, CaseOptions& options);

/// Adds the options of how a drawing is read.
void add_drawing_options(CLI::App& command, DrawingOptions& options);

void add_case_commands(CLI::App& app, Session& session);  ///< presets, check
void add_explain_command(CLI::App& app, Session& session);
void add_import_command(CLI::App& app, Session& session);
void add_show_commands(CLI::App& app, Session& session);  ///< show, list, table
void add_run_command(CLI::App& app, Session& session);
void add_submit_commands(CLI::App& app, Session& session);  ///< submit, sweep
void add_watch_command(CLI::App& app, Session& session);  ///< watch, wait
void add_job_commands(CLI::App& app, Session& session);  ///< cancel, suspend, resume, retry, note, delete
void add_fetch_command(CLI::App& app, Session& session);
void add_plot_command(CLI::App& app, Session& session);
void add_movie_command(CLI::App& app, Session& session);
void add_preview_command(CLI::App& app, Session& session);
void add_export_command(CLI::App& app, Session& session);
void add_queue_commands(CLI::App& app, Session& session);   ///< queue, drain
void add_caller_commands(CLI::App& app, Session& session);  ///< whoami, open
void add_converge_command(CLI::App& app, Session& session);
void add_shell_commands(CLI::App& app, Session& session);  ///< completion, man

/// Adds --executor to a command. `name` stays empty without the option.
void add_executor_option(CLI::App& command, std::string& name);

/// Adds --time-limit to a command. `seconds` stays 0 without the option; `default_text` describes that default.
void add_time_limit_option(CLI::App& command, double& seconds, const std::string& default_text = "the daemon's limit");

/// Whether a name from the command line is a sweep's: "sweeps/NAME".
bool names_sweep(const std::string& name);

/// Whether a name from the command line is a file or folder rather than a job or sweep: it exists, or looks like a
/// path. jobs/12 and 12 are a job even so.
bool names_file(const std::string& name);

/// A sentence on how to name the first of these words that is also a file or folder here, but taken for the name of a
/// job or sweep; empty if none is.
std::string file_hint(const std::vector<std::string>& words);

struct ResultTable {
  v1::SweepTable table;
  std::string note;  ///< in what else the cases differ; empty if in nothing
};
/// A table as of a sweep with a row for each result, under the name given, and the numbers in which their cases differ.
/// Throws the errors of Session::find_jobs.
ResultTable tabulate_results(Session& session, const std::vector<std::string>& files);

/// A job's full name: "jobs/NAME" for a NAME without a slash. Throws CommandError (refused) for a sweep's name.
std::string job_name(const std::string& name);

/// A sweep's full name: "sweeps/NAME" for a NAME without a slash. Throws CommandError (refused) for a job's name.
std::string sweep_name(const std::string& name);

}  // namespace cellcrush::client
