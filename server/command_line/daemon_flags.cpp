#include "command_line/daemon_flags.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <istream>
#include <memory>
#include <set>
#include <stdexcept>

#include "access/token_file.h"
#include "error.h"
#include "http/public_url.h"
#include "slurm/cluster_options.h"
#include "usage/command_entries.h"
#include "usage/suggestion.h"

namespace cellcrush {
namespace {

constexpr std::int64_t kMebibyte = 1024 * 1024;

std::filesystem::path default_data_folder() {
  if (const char* data = std::getenv("XDG_DATA_HOME"); data != nullptr && *data == '/')
    return std::filesystem::path(data) / "cellcrush";
  if (const char* home = std::getenv("HOME"); home != nullptr && *home == '/')
    return std::filesystem::path(home) / ".local/share/cellcrush";
  return {};
}

std::chrono::milliseconds milliseconds_of(double seconds) {
  return std::chrono::milliseconds(std::llround(1000.0 * seconds));
}

// Empty for a value of --slurm that can be read.
std::string cluster_problem(const std::string& text) {
  try {
    slurm::parse_cluster(text);
    return "";
  } catch (const std::invalid_argument& problem) {
    return "cannot be used: " + std::string(problem.what());
  }
}

// Empty for an origin: a scheme, a host and, unless it is that of the scheme, a port.
std::string origin_problem(const std::string& text) {
  constexpr std::string_view kOfHost = "abcdefghijklmnopqrstuvwxyz0123456789.-:[]";
  const std::string_view origin = text;
  const std::size_t scheme = origin.starts_with("https://") ? 8 : origin.starts_with("http://") ? 7 : 0;
  const bool is_origin =
      scheme > 0 && origin.size() > scheme && origin.find_first_not_of(kOfHost, scheme) == std::string_view::npos;
  if (is_origin) return "";
  return fmt::format(
      "\"{}\" is not an origin. Write it as https://HOST or https://HOST:PORT, in lower case and without "
      "a path.",
      text);
}

// Empty for GROUP=SCOPE.
std::string group_scope_problem(const std::string& text) {
  const auto sign = text.rfind('=');
  if (sign != std::string::npos && sign > 0 && access::parse_scope(text.substr(sign + 1))) return "";
  return fmt::format("\"{}\" is not GROUP=SCOPE. The scope is read, submit or admin, as in students=submit.", text);
}

std::string public_url_problem(const std::string& text) {
  try {
    (void)http::parse_public_url(text);
    return "";
  } catch (const ServiceError& error) {
    return error.what();
  }
}

// Reads a TOML file of options and rejects a key that is not an option. Otherwise a misspelt key would silently leave a
// default in force.
class CheckedConfig final : public CLI::ConfigTOML {
 public:
  // `app` defines the options and outlives this object.
  explicit CheckedConfig(const CLI::App& app) : app_(app) {}

  std::vector<CLI::ConfigItem> from_config(std::istream& input) const override {
    auto found = CLI::ConfigTOML::from_config(input);
    std::set<std::string> keys;
    for (const auto& item : found) {
      const std::string key = item.fullname();
      if (item.name != "++" && item.name != "--" && !keys.insert(key).second)
        throw CLI::ConfigError(
            fmt::format("the --config file sets \"{}\" twice. Give all its values in one line.", key),
            CLI::ExitCodes::ConfigError);
      // How the reader represents the start and end of a table.
      const bool is_mark = item.name == "++" || item.name == "--";
      if (is_mark || (item.parents.empty() && app_.get_option_no_throw("--" + key) != nullptr)) continue;
      std::vector<std::string> names;
      for (const OptionEntry& option : option_entries(app_)) names.push_back(option.names.back().substr(2));
      const std::string nearest = find_nearest(key, names);
      const std::string remedy =
          nearest.empty() ? "cellcrushd --help lists all options." : fmt::format("Did you mean \"{}\"?", nearest);
      throw CLI::ConfigError(fmt::format("the --config file sets \"{}\", which is not an option. {}", key, remedy),
                             CLI::ExitCodes::ConfigError);
    }
    return found;
  }

 private:
  const CLI::App& app_;
};

}  // namespace

DaemonFlags::DaemonFlags(CLI::App& app) {
  options_.data_folder = default_data_folder();
  const auto begin_group = [&](const char* name) { app.option_defaults()->group(name); };
  begin_group("Addresses");
  add_addresses(app);
  begin_group("Access");
  add_access(app);
  begin_group("Monitoring");
  add_monitoring(app);
  begin_group("Connections");
  add_connections(app);
  begin_group("Jobs");
  add_limits(app);
  begin_group("Quotas per owner");
  add_owner_limits(app);
  begin_group("Storage");
  add_storage(app);
  begin_group("Times");
  add_times(app);
  begin_group("Options");
  app.add_option("--log-format", log_format_, "Log format: text, or json with one object per line (default: text)")
      ->check(CLI::IsMember({"text", "json"}));
  app.add_option("--log-file", log_file_,
                 "File to which the log is appended; SIGHUP opens it again by its name (default: standard error)")
      ->type_name("FILE");
  app.config_formatter(std::make_shared<CheckedConfig>(app));
  app.set_config("--config", "",
                 "TOML file of options, one per line, by their long names without the leading dashes, such as "
                 "max-queued-jobs = 10 (default: none)");
}

void DaemonFlags::add_addresses(CLI::App& app) {
  app.add_option("--listen", options_.listen,
                 "Address to listen on, unix:PATH or HOST:PORT; may be repeated; port 0 picks a free port (default: "
                 "unix:DIR/cellcrushd.sock, where DIR is --data, and 127.0.0.1:50551)")
      ->type_name("ADDR");
  app.add_option(
         "--http", options_.http,
         "HOST:PORT that serves the API and the web page over HTTP, or over HTTPS with --tls-cert; none: nowhere "
         "(default: 127.0.0.1:8080, or a free port where that is taken)")
      ->type_name("ADDR");
  app.add_option("--allow-framing", options_.framing_origins,
                 "Origin whose pages may show the web page in a frame, such as https://grafana.example.org; may be "
                 "repeated (default: none)")
      ->check(origin_problem)
      ->type_name("ORIGIN");
  app.add_option("--public-url", options_.public_url,
                 "Address of the web page for users where a proxy or tunnel stands before it, such as "
                 "https://site.example.org/crush/ (default: that of --http)")
      ->check(public_url_problem)
      ->type_name("URL");
}

void DaemonFlags::add_monitoring(CLI::App& app) {
  auto& notices = options_.notices;
  app.add_option("--metrics", options_.metrics,
                 "Loopback HOST:PORT for Prometheus metrics, served over HTTP at /metrics (default: not served)")
      ->type_name("ADDR");
  app.add_option(
         "--audit-log", options_.audit_log,
         "File to append changes by callers and calls refused for lack of access to; SIGHUP reopens it (default: "
         "none)")
      ->type_name("FILE");
  app.add_option("--webhook", notices.webhooks,
                 "URL that is told of ended jobs and sweeps and of held queues, in signed messages; may be repeated "
                 "(default: none)")
      ->type_name("URL");
  app.add_option("--webhook-secret", notices.webhook_secret,
                 "File with the key, whsec_BASE64, that signs all webhooks; required with --webhook (default: none)")
      ->type_name("FILE");
  app.add_option("--notify-command", notices.command,
                 "Program that is run for each of these notices, which it reads as JSON, such as one that sends mail "
                 "(default: none)")
      ->type_name("PROGRAM");
  app.add_option("--notify", notices.types,
                 "Notice that --webhook and --notify-command are told: " +
                     fmt::format("{}", fmt::join(notices::kTypes, ", ")) + "; may be repeated (default: all)")
      ->check(CLI::IsMember(std::set<std::string>(notices::kTypes.begin(), notices::kTypes.end())))
      ->type_name("TYPE");
  app.add_option("--traces", notices.traces,
                 "URL of a collector that gets a trace of each ended job as OTLP over HTTP, such as "
                 "http://127.0.0.1:4318/v1/traces (default: none)")
      ->type_name("URL");
}

void DaemonFlags::add_access(CLI::App& app) {
  auto& access = options_.access;
  app.add_option("--tls-cert", access.tls_certificate,
                 "PEM file of the server's certificate chain; every HOST:PORT then requires TLS; SIGHUP reloads it "
                 "together with --tls-key and --tls-client-ca (default: none, plain text)")
      ->type_name("FILE");
  app.add_option("--tls-key", access.tls_key, "PEM file of the certificate's private key (default: none)")
      ->type_name("FILE");
  app.add_option("--tls-client-ca", access.tls_client_authority,
                 "PEM file of the authority that issues client certificates; every TCP client must then present one "
                 "with clientAuth in its extended key usage (default: none)")
      ->type_name("FILE");
  app.add_option("--tls-client-scope", certificate_scope_,
                 "Scope of clients that present a client certificate: read, submit or admin (default: submit)")
      ->check(CLI::IsMember({"read", "submit", "admin"}));
  app.add_option("--tokens", access.tokens,
                 "File of tokens, one per line (see `cellcrushd token`); TCP calls must present one; SIGHUP reloads it "
                 "(default: none)")
      ->type_name("FILE");
  app.add_option("--group-scope", group_scopes_,
                 "Scope of the members of a Unix group on Unix sockets, such as students=submit; may be repeated "
                 "(default: none)")
      ->check(group_scope_problem)
      ->type_name("GROUP=SCOPE");
}

void DaemonFlags::add_connections(CLI::App& app) {
  auto& limits = options_.connections;
  app.add_option("--max-connections", limits.connections,
                 "Maximum number of open connections; the daemon's own user has a separate limit of the same size on "
                 "Unix sockets; fewer where the process may open too few files (default: 1000)")
      ->check(CLI::Range(1, 1'000'000));
  app.add_option("--max-connections-per-address", limits.connections_per_address,
                 "Maximum number of open connections from one address, or of one other Unix user (default: 500)")
      ->check(CLI::Range(1, 1'000'000));
  app.add_option("--max-streams", limits.streams,
                 "Maximum number of open streams: watches, downloads, frames and reflection (default: 2000)")
      ->check(CLI::Range(1, 1'000'000));
  app.add_option("--max-streams-per-caller", limits.streams_per_caller,
                 "Maximum number of open streams of one Unix user, token or certificate (default: 1000)")
      ->check(CLI::Range(1, 1'000'000));
  app.add_option(
         "--max-call-memory", call_memory_mib_,
         "Memory limit for connections, in MiB; messages not yet read have a second limit of the same size (default: "
         "256)")
      ->check(CLI::Range(16, 1 << 20));
}

void DaemonFlags::add_limits(CLI::App& app) {
  app.add_option("--workers", options_.workers,
                 "Maximum number of jobs running at once on this machine (default: one per core)")
      ->check(CLI::Range(1, 1024));
  app.add_option("--device", options_.device,
                 "Device that advances the runs that it can, on this machine, with the same results: cuda, or the path "
                 "of a library for another one; see core/device/README.md (default: none)")
      ->type_name("NAME");
  app.add_option("--slurm", clusters_,
                 "Slurm cluster that computes jobs as executor slurm/NAME: NAME:folder=PATH, where PATH lies on a file "
                 "system that the nodes share; see deploy/slurm/README.md for further settings; may be repeated "
                 "(default: none)")
      ->check(cluster_problem)
      ->type_name("NAME:KEY=VALUE,...");
  app.add_option("--executor", options_.default_executor,
                 "Executor of jobs and sweeps whose request names none: local, for this machine, or another that this "
                 "daemon has (default: local)")
      ->type_name("NAME");
  app.add_option("--max-queued-jobs", options_.limits.queued_jobs,
                 "Maximum number of jobs waiting in the queue (default: 100000)")
      ->check(CLI::Range(1, 10'000'000));
  app.add_option("--max-job-memory", memory_mib_,
                 "Maximum predicted memory of a job, in MiB (default: the machine's memory)")
      ->check(CLI::Range(1, 1 << 30));
  app.add_option("--max-job-time", job_seconds_,
                 "Wall-clock limit per job, in seconds; results up to the limit are kept (default: no limit)")
      ->check(CLI::Range(0.0, 1e9));
}

void DaemonFlags::add_owner_limits(CLI::App& app) {
  auto& owner = options_.limits.owner;
  app.add_option("--owner-max-queued", owner.queued_jobs,
                 "Maximum number of waiting jobs per owner (default: 0, no limit)")
      ->check(CLI::Range(0, 10'000'000));
  app.add_option("--owner-max-running", owner.running_jobs,
                 "Maximum number of running jobs per owner, on each executor; further ones wait (default: 0, no limit)")
      ->check(CLI::Range(0, 1024));
  app.add_option("--owner-max-disk", owner_disk_mib_,
                 "Disk quota per owner in MiB of results and journal; new jobs are refused once it is reached "
                 "(default: 0, no limit)")
      ->check(CLI::Range(0, 1 << 30));
  app.add_option("--owner-max-priority", owner.priority,
                 "Highest priority that an owner may give to a job (default: 100)")
      ->check(CLI::Range(-100, 100));
}

void DaemonFlags::add_storage(CLI::App& app) {
  app.add_option("--data", options_.data_folder,
                 "Data folder for jobs and results (default: $XDG_DATA_HOME/cellcrush or ~/.local/share/cellcrush)")
      ->type_name("DIR");
  app.add_option("--min-free-disk", free_mib_,
                 "Free disk space to keep, in MiB; with less, no job is accepted or started (default: 256)")
      ->check(CLI::Range(0, 1 << 30));
  app.add_option("--keep-ended-jobs", keep_days_,
                 "Days to keep an ended job or sweep; time while no daemon runs does not count (default: 0, forever)")
      ->check(CLI::Range(0.0, 36500.0));
  app.add_option("--keep-ended-count", options_.keep.count,
                 "Number of ended jobs to keep; the oldest are deleted first, a sweep as a whole (default: 0, all)")
      ->check(CLI::Range(0, 100'000'000));
  app.add_option("--keep-ended-size", keep_mib_,
                 "Disk space for ended jobs in MiB of results and journal; the oldest are deleted first, a sweep as a "
                 "whole (default: 0, no limit)")
      ->check(CLI::Range(0, 1 << 30));
}

void DaemonFlags::add_times(CLI::App& app) {
  app.add_option("--checkpoint-interval", checkpoint_seconds_,
                 "Seconds between checkpoints of a running job (default: 60)")
      ->check(CLI::Range(0.01, 86400.0));
  app.add_option("--watch-patience", patience_seconds_,
                 "How long, in seconds, a watcher may stop reading before its stream is closed with RESOURCE_EXHAUSTED "
                 "(default: 600)")
      ->check(CLI::Range(1.0, 86400.0));
}

DaemonOptions DaemonFlags::options() const {
  DaemonOptions out = options_;
  out.access.certificate_scope = access::parse_scope(certificate_scope_).value();
  for (const auto& text : group_scopes_) {
    const auto sign = text.rfind('=');
    out.access.groups[text.substr(0, sign)] = access::parse_scope(text.substr(sign + 1)).value();
  }
  out.connections.memory_bytes = call_memory_mib_ * kMebibyte;
  out.limits.job_memory_bytes = memory_mib_ * kMebibyte;
  out.limits.free_disk_bytes = free_mib_ * kMebibyte;
  out.limits.job_time = std::chrono::duration<double>(job_seconds_);
  out.limits.owner.disk_bytes = owner_disk_mib_ * kMebibyte;
  out.keep.bytes = keep_mib_ * kMebibyte;
  out.keep.age = std::chrono::seconds(std::llround(86400.0 * keep_days_));
  out.checkpoint_interval = milliseconds_of(checkpoint_seconds_);
  for (const auto& cluster : clusters_) out.executors.push_back(slurm::executor_of(slurm::parse_cluster(cluster)));
  out.watch_times.patience = milliseconds_of(patience_seconds_);
  return out;
}

}  // namespace cellcrush
