#include <fmt/format.h>

#include <cstdio>
#include <utility>

#include "case_file/case_source.h"
#include "commands/commands.h"
#include "connection/server_address.h"
#include "terminal/case_text.h"
#include "terminal/json_text.h"

namespace cellcrush::client {

namespace {

ExitCode run_presets(Session& session) {
  Connection& connection = session.connection();
  const auto presets = connection.call(connection.cases(), &v1::Cases::Stub::ListPresets, v1::ListPresetsRequest());
  if (session.json) {
    print_json(presets);
  } else {
    fmt::print("{}", preset_list_text(presets));
  }
  return ExitCode::done;
}

ExitCode run_check(Session& session, const CaseOptions& options) {
  Connection& connection = session.connection();
  v1::CheckCaseRequest request;
  *request.mutable_case_() = read_case(options.source, options.assignments, connection);
  const auto check = connection.call(connection.cases(), &v1::Cases::Stub::CheckCase, request);
  if (check.problems_size() == 0) {
    session.json ? print_json(check) : fmt::print("{}", check_text(check));
    return ExitCode::done;
  }
  if (session.json) {
    print_json(check);
    return ExitCode::refused;
  }
  v1::ProblemList problems;
  *problems.mutable_problems() = check.problems();
  throw problems_error(std::move(problems));
}

}  // namespace

Connection& Session::connection() {
  if (connection_ == nullptr) {
    const std::string address = find_server_address(server);
    connection_ = std::make_unique<Connection>(address, read_credentials(credentials, address));
  }
  return *connection_;
}

CLI::App* add_command(CLI::App& app, Session& session, const std::string& name, const std::string& description,
                      std::function<ExitCode()> action) {
  CLI::App* command = app.add_subcommand(name, description);
  command->add_flag("--json", session.json, "Answer with protobuf JSON, an object a line");
  command->add_option("--server", session.server,
                      "unix:PATH or HOST:PORT (default: $CELLCRUSH_SERVER, else the daemon's socket in the user's data "
                      "folder, else 127.0.0.1:50551)");
  command->add_option("--tls-ca", session.credentials.authority,
                      "PEM file of the authority that signed the server's certificate; makes a HOST:PORT one of TLS "
                      "(default: $CELLCRUSH_TLS_CA)");
  command->add_option("--tls-cert", session.credentials.certificate,
                      "PEM file of a certificate to show to the server (default: none)");
  command->add_option("--tls-key", session.credentials.key, "PEM file of that certificate's key (default: none)");
  command->add_option("--token-file", session.credentials.token,
                      "File of the token for a HOST:PORT (default: $CELLCRUSH_TOKEN_FILE, or $CELLCRUSH_TOKEN itself)");
  command->callback([&session, action = std::move(action)] { session.action = action; });
  return command;
}

void add_case_options(CLI::App& command, CaseOptions& options) {
  command.add_option("CASE", options.source, "A case file, - for stdin, or preset:NAME")->required();
  command
      .add_option(
          "--set", options.assignments,
          "PATH=VALUE: changes a field of the case, such as loading.speed_m_per_s=100 (may be repeated; default: none)")
      ->allow_extra_args(false);
}

void add_case_commands(CLI::App& app, Session& session) {
  add_command(app, session, "presets", "List the cases that come with the server",
              [&session] { return run_presets(session); });
  const auto options = std::make_shared<CaseOptions>();
  CLI::App* check = add_command(app, session, "check", "Say what a case takes to run, or all that is wrong with it",
                                [&session, options] { return run_check(session, *options); });
  add_case_options(*check, *options);
}

}  // namespace cellcrush::client
