// cellcrushd: parses flags, serves until a signal asks it to end. Exit codes: 0 ended in order, 1 could not start, 2
// usage.
#include <malloc.h>
#include <spdlog/spdlog.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "access/token_file.h"
#include "allotment.h"
#include "cellcrush/simd.h"
#include "checked_options.h"
#include "command_line/daemon_flags.h"
#include "command_line/store_commands.h"
#include "daemon.h"
#include "log_format.h"
#include "log_writer.h"
#include "open_file.h"
#include "revision.h"
#include "slurm/task.h"
#include "usage/help_formatter.h"
#include "usage/man_page.h"
#include "usage/suggestion.h"
#include "worker/worker_main.h"

namespace {

constexpr const char* kFooter =
    "SIGTERM and SIGINT stop the daemon: running jobs are checkpointed, and the next daemon resumes them.\n"
    "SIGHUP reloads certificates and tokens, and opens the log file again.\n"
    "Exit codes: 0 stopped by a signal, or the command is done; 1 failed; 2 usage error.\n"
    "Environment: CELLCRUSH_SIMD names the SIMD kernel to use instead of the fastest one.";

constexpr int kHelpColumns = 80;

const cellcrush::ManPage kManPage = {.section = 8,
                                     .manual = "System Administration",
                                     .version = CELLCRUSH_VERSION,
                                     .summary = "daemon that runs crushing analyses of cellular materials",
                                     .synopsis = "[OPTIONS] [COMMAND ...]",
                                     .see_also = "cellcrush (1)"};

// Where the service of the package stores and listens (deploy/debian). Only accounts of this machine reach the service.
const std::map<std::string, std::string> kOfService = {{"data", "\"/var/lib/cellcrush\""},
                                                       {"group-scope", "[\"cellcrush=submit\"]"},
                                                       {"http", "\"none\""},
                                                       {"listen", "[\"unix:/run/cellcrush/cellcrushd.sock\"]"}};

// Only main waits for SIGTERM, SIGINT and SIGHUP; they are blocked before another thread exists.
sigset_t block_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGTERM, SIGINT, SIGHUP}) sigaddset(&signals, signal);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  signal(SIGPIPE, SIG_IGN);
  return signals;
}

// CELLCRUSH_SIMD selects the kernel, for the daemon and for workers, which inherit it.
bool choose_kernel() {
  const char* name = std::getenv("CELLCRUSH_SIMD");
  if (name == nullptr || cellcrush::use_simd_target(name)) return true;
  std::string known;
  for (const auto& target : cellcrush::simd_targets()) known += (known.empty() ? "" : ", ") + target;
  std::fprintf(
      stderr,
      "cellcrushd: CELLCRUSH_SIMD is '%s', which this processor cannot run. Set it to one of %s, or unset it.\n", name,
      known.c_str());
  return false;
}

// Two lines on stdout, the token and its line for the token file; explanations on stderr.
int print_token(const std::string& name, const std::string& scope) {
  try {
    const auto made = cellcrush::access::make_token(name, cellcrush::access::parse_scope(scope).value());
    std::printf("%s\n%s\n", made.token.c_str(), made.line.c_str());
    std::fprintf(stderr,
                 "The first line is the token. Give it to its owner; it is not stored. The second line contains only "
                 "its hash. Append it to the --tokens file.\n");
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "cellcrushd: %s\n", error.what());
    return 2;
  }
}

std::shared_ptr<cellcrush::LogWriter> open_log(const std::filesystem::path& file) {
  try {
    return std::make_shared<cellcrush::LogWriter>(file);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "cellcrushd: --log-file: %s\n", error.what());
    return nullptr;
  }
}

void read_files_again(cellcrush::Daemon& daemon, cellcrush::LogWriter& log) {
  try {
    log.reopen();
  } catch (const std::exception& error) {
    spdlog::error("The log stays in the file that is open: {}", error.what());
  }
  daemon.read_files_again();
}

// Tells systemd how the daemon is, if it asks with Type=notify (sd_notify(3)).
void notify_manager(std::string_view state) {
  const char* path = std::getenv("NOTIFY_SOCKET");
  sockaddr_un address{};
  const std::size_t length = path == nullptr ? 0 : std::strlen(path);
  if (length == 0 || length >= sizeof(address.sun_path)) return;
  address.sun_family = AF_UNIX;
  std::memcpy(address.sun_path, path, length);
  if (path[0] == '@') address.sun_path[0] = '\0';  // without a file
  const cellcrush::OpenFile socket(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  sendto(socket.get(), state.data(), state.size(), MSG_DONTWAIT | MSG_NOSIGNAL,
         reinterpret_cast<const sockaddr*>(&address), static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + length));
}

// On a thread of its own, since perhaps nobody reads.
void print_addresses(const std::vector<std::string>& addresses) {
  std::string text;
  for (const auto& address : addresses) text += "cellcrushd is listening on " + address + "\n";
  std::thread([text] { cellcrush::write_text(STDOUT_FILENO, text); }).detach();
}

int check(const cellcrush::DaemonOptions& options) {
  try {
    for (const auto& line : cellcrush::check_options(options)) std::printf("%s\n", line.c_str());
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "cellcrushd: %s\n", error.what());
    return 2;
  }
}

int serve(const cellcrush::DaemonOptions& options, const sigset_t& signals, cellcrush::LogWriter& log) {
  try {
    cellcrush::Daemon daemon(options);
    print_addresses(daemon.addresses());
    notify_manager("READY=1");
    int received = 0;
    while (sigwait(&signals, &received) == 0 && received == SIGHUP) read_files_again(daemon, log);
    spdlog::info("stopping on {}", received == SIGTERM ? "SIGTERM" : "SIGINT");
    notify_manager("STOPPING=1");
    daemon.stop();
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "cellcrushd: %s\n", error.what());
    return 1;
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "cellcrushd runs crushing analyses: it accepts cases over gRPC, runs them as jobs, and streams their progress "
      "and results.");
  app.name("cellcrushd");
  app.formatter(std::make_shared<cellcrush::HelpFormatter>(kHelpColumns));
  app.failure_message([](const CLI::App* failed, const CLI::Error& error) {
    return "cellcrushd: " + cellcrush::usage_message(*failed, error) + "\n";
  });
  cellcrush::DaemonFlags flags(app);
  app.set_version_flag("--version", std::string("cellcrushd ") + cellcrush::kVersionText);
  std::string token_name;
  std::string token_scope;
  CLI::App* token = app.add_subcommand("token", "Print a new token and its line for the --tokens file");
  token
      ->add_option("NAME", token_name,
                   "Owner of the token: 1 to 64 printable characters without spaces, quotes, backslashes or #")
      ->required();
  token
      ->add_option(
          "--scope", token_scope,
          "Scope of the token. read: read only; submit: also create jobs and change one's own; admin: everything")
      ->required()
      ->check(CLI::IsMember({"read", "submit", "admin"}));
  const CLI::App* check_config =
      app.add_subcommand("check-config",
                         "Check the options and the files that they name, and start nothing; exit code 2 if the daemon "
                         "would not start with them")
          ->fallthrough();
  const cellcrush::StoreCommands store_commands(app);
  // For packages and for the daemon itself; an empty group hides them from the help.
  const CLI::App* man = app.add_subcommand("man", "Print the man page")->group("");
  const CLI::App* config_file = app.add_subcommand("config-file", "Print the file of the service")->group("");
  std::filesystem::path job_folder;
  CLI::App* worker = app.add_subcommand("worker")->group("");
  worker->add_option("--folder", job_folder)->required();
  pid_t parent = 0;
  worker->add_option("--end-with", parent);
  // For the script of a Slurm job.
  cellcrush::slurm::TaskOptions task_options;
  double lease_seconds = 300.0;
  CLI::App* task = app.add_subcommand("task")->group("");
  task->add_option("--folder", task_options.folder);
  task->add_option("--batch", task_options.batch);
  task->add_option("--lease", lease_seconds);
  app.footer(kFooter);  // last, since commands inherit the settings of the program
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  if (man->parsed()) {
    std::printf("%s", cellcrush::man_page(app, kManPage).c_str());
    return 0;
  }
  if (config_file->parsed()) {
    std::printf("%s", cellcrush::config_file(app, kOfService).c_str());
    return 0;
  }
  if (token->parsed()) return print_token(token_name, token_scope);
  if (!choose_kernel()) return 2;
  umask(0077);
  if (worker->parsed()) cellcrush::worker::worker_main(job_folder, parent);
  cellcrush::DaemonOptions options = flags.options();
  if (check_config->parsed()) return check(options);
  const auto log = open_log(flags.log_file());
  if (!log) return 1;
  spdlog::set_default_logger(std::make_shared<spdlog::logger>("cellcrushd", log));
  spdlog::set_formatter(flags.log_format() == "json" ? cellcrush::make_json_formatter()
                                                     : cellcrush::make_text_formatter());
  if (task->parsed()) {
    task_options.lease = std::chrono::milliseconds(std::llround(1000.0 * lease_seconds));
    return cellcrush::slurm::run_task(task_options);
  }
  if (store_commands.given()) return store_commands.run(options.data_folder);
  if (options.data_folder.empty()) {
    std::fprintf(stderr, "cellcrushd: neither XDG_DATA_HOME nor HOME is set. Give a data folder with --data.\n");
    return 2;
  }
  options.on_drain = [] { kill(getpid(), SIGTERM); };
  options.on_progress = [] { notify_manager("WATCHDOG=1"); };
  // The C library would keep eight heaps for each core, each at the size of its largest flood. With fewer
  // than two, the threads of calls wait for each other.
  mallopt(M_ARENA_MAX, 2 * std::max(2, cellcrush::usable_cores().count));
  const sigset_t signals = block_signals();
  return serve(options, signals, *log);
}
