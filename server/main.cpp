// cellcrushd: parses flags, serves until a signal asks it to end. Exit codes: 0 ended in order, 1 could not start, 2
// usage.
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <sys/stat.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "access/token_file.h"
#include "cellcrush/simd.h"
#include "daemon.h"
#include "log_format.h"
#include "version.h"
#include "worker/worker_main.h"

namespace {

std::filesystem::path default_data_folder() {
  if (const char* data = std::getenv("XDG_DATA_HOME"); data != nullptr && *data == '/')
    return std::filesystem::path(data) / "cellcrush";
  if (const char* home = std::getenv("HOME"); home != nullptr && *home == '/')
    return std::filesystem::path(home) / ".local/share/cellcrush";
  return {};
}

// SIGTERM, SIGINT and, where there are tokens to read again, SIGHUP are waited for by main alone; blocked before any other thread
// exists.
sigset_t block_signals(bool has_tokens) {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  if (has_tokens) sigaddset(&signals, SIGHUP);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  signal(SIGPIPE, SIG_IGN);
  return signals;
}

// CELLCRUSH_SIMD names the kernel to use, for the daemon and the workers, which inherit it.
bool choose_kernel() {
  const char* name = std::getenv("CELLCRUSH_SIMD");
  if (name == nullptr || cellcrush::use_simd_target(name)) return true;
  std::string known;
  for (const auto& target : cellcrush::simd_targets()) known += (known.empty() ? "" : ", ") + target;
  std::fprintf(stderr,
               "cellcrushd: CELLCRUSH_SIMD is '%s', which this processor cannot run. Give one of %s, or unset it.\n",
               name, known.c_str());
  return false;
}

// Two lines on stdout, the token and what the file takes; words about them on stderr.
int print_token(const std::string& name, const std::string& scope) {
  try {
    const auto made = cellcrush::access::make_token(name, cellcrush::access::parse_scope(scope).value());
    std::printf("%s\n%s\n", made.token.c_str(), made.line.c_str());
    std::fprintf(
        stderr,
        "The first line is the token: give it to its owner, it is not kept. The second one, which has its hash "
        "only, goes into the file of --tokens.\n");
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "cellcrushd: %s\n", error.what());
    return 2;
  }
}

int serve(const cellcrush::DaemonOptions& options, const sigset_t& signals) {
  try {
    cellcrush::Daemon daemon(options);
    for (const auto& address : daemon.addresses()) std::printf("cellcrushd is listening on %s\n", address.c_str());
    std::fflush(stdout);
    int received = 0;
    while (sigwait(&signals, &received) == 0 && received == SIGHUP) daemon.read_tokens_again();
    spdlog::info("ends on {}", received == SIGTERM ? "SIGTERM" : "SIGINT");
    daemon.stop();
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "cellcrushd: %s\n", error.what());
    return 1;
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("cellcrushd hosts the solver: it takes cases over gRPC, runs them, and streams what comes of them.");
  cellcrush::DaemonOptions options;
  options.data_folder = default_data_folder();
  app.add_option("--listen", options.listen,
                 "unix:PATH or HOST:PORT, may be repeated; port 0 takes a free one "
                 "(default: unix:DIR/cellcrushd.sock and 127.0.0.1:50551)");
  app.add_option("--data", options.data_folder,
                 "folder of jobs and results (default: $XDG_DATA_HOME/cellcrush or ~/.local/share/cellcrush)");
  app.add_option(
      "--tls-cert", options.access.tls_certificate,
      "PEM file of this server's certificate; every HOST:PORT then takes TLS only (default: none, plain text)");
  app.add_option("--tls-key", options.access.tls_key, "PEM file of the certificate's key (default: none)");
  app.add_option("--tls-client-ca", options.access.tls_client_authority,
                 "PEM file of the authority that signs clients' certificates; one is then asked of every client on TCP "
                 "(default: none)");
  std::string certificate_scope = "submit";
  app.add_option("--tls-client-scope", certificate_scope,
                 "what those may do who show such a certificate: read, submit or admin (default: submit)")
      ->check(CLI::IsMember({"read", "submit", "admin"}));
  app.add_option("--tokens", options.access.tokens,
                 "file of the tokens that calls on TCP must carry, a line each, see `cellcrushd token`; read again on "
                 "SIGHUP (default: none)");
  app.add_option(
      "--metrics", options.metrics,
      "HOST:PORT of loopback at which metrics for Prometheus are served over HTTP, at /metrics (default: nowhere)");
  app.add_option("--workers", options.workers, "jobs that run at once (default: one for each core)")
      ->check(CLI::Range(1, 1024));
  app.set_config("--config", "",
                 "file of options in TOML, a line each: their long names without the dashes (default: none)");
  constexpr std::int64_t kMebibyte = 1024 * 1024;
  std::int64_t memory_mib = 0;
  std::int64_t free_mib = 256;
  double keep_days = 0.0;
  app.add_option("--max-queued-jobs", options.limits.queued_jobs, "jobs that may wait (default: 100000)")
      ->check(CLI::Range(1, 10'000'000));
  app.add_option("--max-job-memory", memory_mib,
                 "MiB that a job may be predicted to need (default: what the machine has)")
      ->check(CLI::Range(1, 1 << 30));
  double job_seconds = 0.0;
  app.add_option(
         "--max-job-time", job_seconds,
         "seconds of clock that a job's workers may take in all; it then ends with what there is (default: no limit)")
      ->check(CLI::Range(0.0, 1e9));
  app.add_option("--min-free-disk", free_mib,
                 "MiB that are kept free in the data folder: below it no job is taken and none runs (default: 256)")
      ->check(CLI::Range(0, 1 << 30));
  app.add_option("--keep-ended-jobs", keep_days,
                 "days after which a job that has ended is deleted (default: 0, which is never)")
      ->check(CLI::Range(0.0, 36500.0));
  std::string log_format = "text";
  app.add_option("--log-format", log_format, "text or json, an object a line (default: text)")
      ->check(CLI::IsMember({"text", "json"}));
  double checkpoint_seconds = 60.0;
  app.add_option("--checkpoint-interval", checkpoint_seconds,
                 "seconds of clock between two checkpoints of a running job (default: 60)")
      ->check(CLI::Range(0.01, 86400.0));
  double patience_seconds = 600.0;
  app.add_option("--watch-patience", patience_seconds,
                 "seconds in which a watcher has read nothing, though there is news, after which its watch is closed "
                 "with RESOURCE_EXHAUSTED (default: 600)")
      ->check(CLI::Range(1.0, 86400.0));
  app.set_version_flag("--version", std::string("cellcrushd ") + cellcrush::kSolverRevision);
  std::string token_name;
  std::string token_scope;
  CLI::App* token = app.add_subcommand("token", "print a new token and its line for the file of --tokens, and end");
  token
      ->add_option("NAME", token_name,
                   "whom the token is for: 1 to 64 printable characters without spaces, quotes, backslashes and #")
      ->required();
  token->add_option("--scope", token_scope, "read; submit: also make jobs and change one's own; admin: all")
      ->required()
      ->check(CLI::IsMember({"read", "submit", "admin"}));
  // What the daemon itself starts; an empty group keeps it out of the help.
  std::filesystem::path job_folder;
  CLI::App* worker = app.add_subcommand("worker")->group("");
  worker->add_option("--folder", job_folder)->required();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  if (token->parsed()) return print_token(token_name, token_scope);
  options.access.certificate_scope = cellcrush::access::parse_scope(certificate_scope).value();
  if (!choose_kernel()) return 2;
  umask(0077);
  if (worker->parsed()) cellcrush::worker::worker_main(job_folder);
  if (options.data_folder.empty()) {
    std::fprintf(stderr, "cellcrushd: neither XDG_DATA_HOME nor HOME is set. Give a data folder with --data.\n");
    return 2;
  }
  options.limits.job_memory_bytes = memory_mib * kMebibyte;
  options.limits.free_disk_bytes = free_mib * kMebibyte;
  options.limits.job_time = std::chrono::duration<double>(job_seconds);
  options.keep_ended_jobs = std::chrono::seconds(std::llround(86400.0 * keep_days));
  options.on_drain = [] { kill(getpid(), SIGTERM); };
  options.checkpoint_interval = std::chrono::milliseconds(std::llround(1000.0 * checkpoint_seconds));
  options.watch_times.patience = std::chrono::milliseconds(std::llround(1000.0 * patience_seconds));
  const sigset_t signals = block_signals(!options.access.tokens.empty());
  spdlog::set_default_logger(spdlog::stderr_color_mt("cellcrushd"));
  spdlog::set_formatter(log_format == "json" ? cellcrush::make_json_formatter() : cellcrush::make_text_formatter());
  return serve(options, signals);
}
