#include "commands/commands.h"

#include <utility>

#include "connection/server_address.h"

namespace cellcrush::client {

namespace {

constexpr const char* kSharedOptions = "`cellcrush --help` describes --json and the connection options.";

}  // namespace

Connection& Session::connection() {
  if (connection_ == nullptr) {
    const std::string address = find_server_address(server);
    connection_ = std::make_unique<Connection>(address, read_credentials(credentials, address));
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
      "Server address, unix:PATH or HOST:PORT (default: $CELLCRUSH_SERVER, else the daemon's socket in the user's data "
      "folder, else "
      "127.0.0.1:50551)");
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

CLI::App* add_command(CLI::App& app, Session& session, const std::string& name, const std::string& description,
                      std::function<ExitCode()> action) {
  CLI::App* command = app.add_subcommand(name, description);
  command->footer(kSharedOptions);
  command->callback([&session, action = std::move(action)] { session.action = action; });
  return command;
}

void add_examples(CLI::App& command, const std::vector<std::string>& examples) {
  std::string footer = "Examples:\n";
  for (const std::string& example : examples) footer += "  " + example + '\n';
  command.footer(footer + '\n' + kSharedOptions);
}

void add_case_options(CLI::App& command, CaseOptions& options) {
  command.add_option("CASE", options.source, "A case file, - for stdin, or preset:NAME")->required();
  command
      .add_option("--set", options.assignments,
                  "Set a field of the case, PATH=VALUE, such as loading.speed_m_per_s=100; `cellcrush explain` "
                  "lists the fields (may be repeated; default: none)")
      ->group(kCaseOptions)
      ->allow_extra_args(false);
}

}  // namespace cellcrush::client
