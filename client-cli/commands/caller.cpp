#include <fmt/format.h>
#include <spawn.h>
#include <unistd.h>

#include <cstdlib>
#include <memory>
#include <string>

#include "commands/commands.h"
#include "terminal/terminal.h"

namespace cellcrush::client {

namespace {

ExitCode run_whoami(Session& session) {
  Connection& connection = session.connection();
  const auto who = connection.call(connection.admin(), &v1::Admin::Stub::WhoAmI, v1::WhoAmIRequest());
  if (session.json) {
    print_json(who);
    return ExitCode::done;
  }
  fmt::print("caller               {}\nscope                {}\nserver               {}\n", printable(who.name()),
             printable(who.scope()), connection.address());
  fmt::print("owner of the server  {}\nepoch                {}\n", printable(who.server_owner()),
             printable(who.epoch()));
  return ExitCode::done;
}

// Where a person looks at this terminal and has a desktop. A browser that does not start leaves the printed link.
void show_in_browser(const std::string& url) {
  const bool has_desktop = std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr;
  if (!has_desktop || isatty(STDOUT_FILENO) != 1) return;
  std::string program = "xdg-open";
  std::string argument = url;
  char* const words[] = {program.data(), argument.data(), nullptr};
  pid_t browser = 0;
  posix_spawnp(&browser, words[0], nullptr, nullptr, words, environ);
}

ExitCode run_open(Session& session, const std::string& name) {
  Connection& connection = session.connection();
  v1::CreateLinkRequest request;
  if (!name.empty()) request.set_page(names_sweep(name) ? name : job_name(name));
  const auto link = connection.call(connection.admin(), &v1::Admin::Stub::CreateLink, request);
  session.json ? print_json(link) : fmt::print("{}\n", link.url());
  if (!session.json) show_in_browser(link.url());
  return ExitCode::done;
}

}  // namespace

void add_caller_commands(CLI::App& app, Session& session) {
  CLI::App* whoami = add_command(app, session, kServerCommands, "whoami",
                                 "Print who you are to the server, what you may do, and whose the server is",
                                 [&session] { return run_whoami(session); });
  add_examples(*whoami, {"cellcrush whoami", "cellcrush whoami --json"});
  const auto name = std::make_shared<std::string>();
  CLI::App* open = add_command(app, session, kServerCommands, "open",
                               "Print a link that signs a browser in, once and within 5 minutes; on a desktop, open it",
                               [&session, name] { return run_open(session, *name); });
  open->add_option("NAME", *name, "Job or sweep to show (default: the list of jobs)");
  add_examples(*open, {"cellcrush open", "cellcrush open jobs/12"});
}

}  // namespace cellcrush::client
