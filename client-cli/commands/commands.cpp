#include "commands/commands.h"

#include <fmt/format.h>

#include <CLI/Validators.hpp>
#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "command_error.h"
#include "connection/credentials.h"
#include "connection/private_daemon.h"

namespace cellcrush::client {

namespace {

constexpr const char* kSharedOptions = "`cellcrush --help` describes --json and the connection options.";

constexpr const char* kJobs = "jobs/";
constexpr const char* kSweeps = "sweeps/";

std::string with_prefix(const std::string& name, const char* prefix) {
  return name.find('/') == std::string::npos ? prefix + name : name;
}

[[noreturn]] void refuse_beside_file(const std::string& name, const std::string& file) {
  if (names_sweep(name))
    refuse(
        fmt::format("{} is a sweep on a server and {} a file; one command cannot read both. Name only one sweep, or "
                    "only results.",
                    name, file));
  refuse(
      fmt::format("{} is a job on a server and {} a file; one command cannot read both. Save the job first, "
                  "`cellcrush fetch {} -o FOLDER`, and name that folder.",
                  name, file, name));
}

}  // namespace

Session::Session() = default;
Session::~Session() = default;

std::vector<std::string> Session::find_jobs(const std::vector<std::string>& names) {
  std::vector<std::string> jobs;
  const auto file = std::ranges::find_if(names, names_file);
  if (file == names.end()) {
    for (const std::string& name : names) jobs.push_back(job_name(name));
    return jobs;
  }
  for (const std::string& name : names) {
    if (!names_file(name)) refuse_beside_file(name, *file);
    jobs.push_back(kJobs + std::to_string(jobs.size() + 1));
  }
  if (!server.empty()) refuse(*file + " is read without a server. Leave --server out.");
  private_ = std::make_unique<PrivateDaemon>(names);
  server = private_->address();
  return jobs;
}

void Session::use_private_server() {
  if (!server.empty()) return;
  private_ = std::make_unique<PrivateDaemon>(std::vector<std::string>());
  server = private_->address();
}

Connection& Session::connection() {
  if (connection_ == nullptr) {
    const ServerAddress address = find_server_address(server);
    connection_ = std::make_unique<Connection>(address, read_credentials(credentials, address.text));
  }
  return *connection_;
}

void add_shared_options(CLI::App& app, Session& session) {
  app.fallthrough();
  app.add_flag("--json", session.json, "Print protobuf JSON, one object per line");
  const auto add = [&app](const char* name, std::string& value, const char* description) {
    app.add_option(name, value, description)->group("Connection")->take_last();
  };
  add("--server", session.server,
      "Server address, unix:PATH or HOST:PORT (default: $CELLCRUSH_SERVER, else the socket of your own daemon, else "
      "127.0.0.1:50551; another user's server is changed only if it is named)");
  add("--tls-ca", session.credentials.authority,
      "PEM file of the certificate authority that signed the server's certificate; turns on TLS for HOST:PORT "
      "(default: "
      "$CELLCRUSH_TLS_CA)");
  add("--tls-cert", session.credentials.certificate,
      "PEM file of the client certificate, if the server requires one (default: none)");
  add("--tls-key", session.credentials.key, "PEM file of the private key of --tls-cert (default: none)");
  add("--token-file", session.credentials.token,
      "File with the token for a HOST:PORT (default: $CELLCRUSH_TOKEN_FILE, or the token in $CELLCRUSH_TOKEN)");
}

CLI::App* add_command(CLI::App& app, Session& session, const char* group, const std::string& name,
                      const std::string& description, std::function<ExitCode()> action) {
  CLI::App* command = app.add_subcommand(name, description)->group(group);
  command->footer(kSharedOptions);
  command->callback([&session, action = std::move(action)] { session.action = action; });
  return command;
}

void add_examples(CLI::App& command, const std::vector<std::string>& examples) {
  std::string footer = "Examples:\n";
  for (const std::string& example : examples) footer += "  " + example + '\n';
  command.footer(footer + '\n' + kSharedOptions);
}

void add_drawing_options(CLI::App& command, DrawingOptions& options) {
  const auto add = [&](const std::string& name, auto& value, const std::string& description) {
    return add_option(command, kCaseOptions, name, value, description);
  };
  add("--unit", options.unit, "Unit of the drawing: mm, cm, m, um, in, ft, pt or px (default: as the file tells)");
  add("--thickness", options.thickness, "Thickness in mm of walls whose drawing does not tell it (default: none)");
  add("--tolerance", options.tolerance,
      "Distance in mm within which ends of a drawing are one joint (default: a thousandth of its shortest wall)");
  add("--bond", options.bond,
      "Walls face to face, a thickness apart to within this share of it, become one wall of both; 0: they slide "
      "(default: 0.05)")
      ->check(CLI::Range(0.0, 0.5).description(""));
  add("--keep-crossings", options.keeps_crossings, "Do not join walls of a drawing where they cross");
}

void add_case_options(CLI::App& command, CaseOptions& options) {
  command.add_option("CASE", options.source, "A case file, - for stdin, or preset:NAME")->required();
  CLI::Option* lattice =
      add_option(command, kCaseOptions, "--lattice", options.lattice.files,
                 "Drawing in place of the lattice of the case: a .csv, .json, .dxf, .svg, .inp or .msh file; of .csv "
                 "also two files, nodes and edges, each with its own --lattice (default: none)");
  lattice->allow_extra_args(false)->type_name("FILE");
  add_drawing_options(command, options.lattice);
  command
      .add_option("--set", options.assignments,
                  "Set a field of the case, PATH=VALUE, such as loading.speed_m_per_s=100; `cellcrush explain` "
                  "lists the fields (may be repeated; default: none)")
      ->group(kCaseOptions)
      ->allow_extra_args(false);
}

void add_executor_option(CLI::App& command, std::string& name) {
  command
      .add_option("--executor", name,
                  "Where jobs are computed: local, for the server's machine, or another executor of the server, such "
                  "as slurm/NAME (default: the server's --executor)")
      ->group(kScheduleOptions)
      ->type_name("NAME");
}

void add_time_limit_option(CLI::App& command, double& seconds, const std::string& default_text) {
  const std::map<std::string, double> units = {{"s", 1.0}, {"min", 60.0}, {"h", 3600.0}, {"d", 86400.0}};
  command
      .add_option("--time-limit", seconds,
                  "Wall-clock limit per job in s, min, h or d, such as 90s or 2h, at least 0.001 s; results up to the "
                  "limit are kept (default: " +
                      default_text + ")")
      ->group(kScheduleOptions)
      ->type_name("TIME")
      ->transform(CLI::AsNumberWithUnit(units, CLI::AsNumberWithUnit::CASE_SENSITIVE).description(""))
      ->check(CLI::Range(0.001, 1e9).description(""));
}

bool names_sweep(const std::string& name) { return name.starts_with(kSweeps); }

bool names_file(const std::string& name) {
  const auto is_number = [](std::string_view text) {
    return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
  };
  const bool has_prefix = name.starts_with(kJobs) || names_sweep(name);
  if (is_number(has_prefix ? name.substr(name.find('/') + 1) : name)) return false;
  std::error_code error;
  return std::filesystem::exists(name, error) || name.ends_with(".h5") || name.starts_with('.') ||
         name.starts_with('/');
}

std::string file_hint(const std::vector<std::string>& words) {
  std::error_code error;
  for (const std::string& word : words) {
    const bool is_name =
        word.find_first_not_of("0123456789") == std::string::npos || word.starts_with(kJobs) || names_sweep(word);
    if (is_name && !names_file(word) && std::filesystem::exists(word, error))
      return fmt::format("To read the file or folder {0}, name it ./{0}.", word);
  }
  return {};
}

std::string job_name(const std::string& name) {
  if (names_sweep(name)) refuse(name + " is a sweep; name one of its jobs, jobs/NAME");
  return with_prefix(name, kJobs);
}

std::string sweep_name(const std::string& name) {
  if (name.starts_with(kJobs)) refuse(name + " is a job; name a sweep, sweeps/NAME");
  return with_prefix(name, kSweeps);
}

}  // namespace cellcrush::client
