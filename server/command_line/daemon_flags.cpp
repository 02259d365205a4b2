#include "command_line/daemon_flags.h"

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>

#include "access/scope.h"
#include "command_line/checked_config.h"

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

}  // namespace

DaemonFlags::DaemonFlags(CLI::App& app) {
  options_.data_folder = default_data_folder();
  add_addresses(app);
  add_access(app);
  add_connections(app);
  add_limits(app);
  add_owner_limits(app);
  add_storage(app);
  add_times(app);
  app.add_option("--log-format", log_format_, "text or json, an object a line (default: text)")
      ->check(CLI::IsMember({"text", "json"}));
  app.config_formatter(std::make_shared<CheckedConfig>(app));
  app.set_config("--config", "",
                 "file of options in TOML, a line each: their long names without the dashes (default: none)");
}

void DaemonFlags::add_addresses(CLI::App& app) {
  app.add_option("--listen", options_.listen,
                 "unix:PATH or HOST:PORT, may be repeated; port 0 takes a free one "
                 "(default: unix:DIR/cellcrushd.sock and 127.0.0.1:50551)");
  app.add_option(
      "--metrics", options_.metrics,
      "HOST:PORT of loopback at which metrics for Prometheus are served over HTTP, at /metrics (default: nowhere)");
}

void DaemonFlags::add_access(CLI::App& app) {
  auto& access = options_.access;
  app.add_option(
      "--tls-cert", access.tls_certificate,
      "PEM file of this server's certificate; every HOST:PORT then takes TLS only; read again on SIGHUP, with its key "
      "and --tls-client-ca (default: none, plain text)");
  app.add_option("--tls-key", access.tls_key, "PEM file of the certificate's key (default: none)");
  app.add_option(
      "--tls-client-ca", access.tls_client_authority,
      "PEM file of the authority that signs clients' certificates; every client on TCP must then show one, with "
      "clientAuth in its extended key usage (default: none)");
  app.add_option("--tls-client-scope", certificate_scope_,
                 "what those may do who show such a certificate: read, submit or admin (default: submit)")
      ->check(CLI::IsMember({"read", "submit", "admin"}));
  app.add_option("--tokens", access.tokens,
                 "file of the tokens that calls on TCP must carry, a line each, see `cellcrushd token`; read again on "
                 "SIGHUP (default: none)");
}

void DaemonFlags::add_connections(CLI::App& app) {
  auto& limits = options_.connections;
  app.add_option("--max-connections", limits.connections,
                 "TCP connections that may be open, and as many on Unix sockets; fewer where the limit on file "
                 "descriptors is too low (default: 1000)")
      ->check(CLI::Range(1, 1'000'000));
  app.add_option("--max-connections-per-address", limits.connections_per_address,
                 "TCP connections that one address may have open (default: 500)")
      ->check(CLI::Range(1, 1'000'000));
  app.add_option("--max-streams", limits.streams,
                 "watches, downloads, frames and reflection streams that may be open (default: 2000)")
      ->check(CLI::Range(1, 1'000'000));
  app.add_option("--max-streams-per-caller", limits.streams_per_caller,
                 "those that one token or certificate may have open (default: 1000)")
      ->check(CLI::Range(1, 1'000'000));
  app.add_option("--max-call-memory", call_memory_mib_,
                 "MiB that connections may take, and as much for messages that wait to be read (default: 256)")
      ->check(CLI::Range(16, 1 << 20));
}

void DaemonFlags::add_limits(CLI::App& app) {
  app.add_option("--workers", options_.workers, "jobs that run at once (default: one for each core)")
      ->check(CLI::Range(1, 1024));
  app.add_option("--max-queued-jobs", options_.limits.queued_jobs, "jobs that may wait (default: 100000)")
      ->check(CLI::Range(1, 10'000'000));
  app.add_option("--max-job-memory", memory_mib_,
                 "MiB that a job may be predicted to need (default: what the machine has)")
      ->check(CLI::Range(1, 1 << 30));
  app.add_option("--max-job-time", job_seconds_,
                 "wall-clock limit per job, in seconds; results up to the limit are kept (default: no limit)")
      ->check(CLI::Range(0.0, 1e9));
}

void DaemonFlags::add_owner_limits(CLI::App& app) {
  auto& owner = options_.limits.owner;
  app.add_option("--owner-max-queued", owner.queued_jobs, "jobs of one owner that may wait (default: 0, no limit)")
      ->check(CLI::Range(0, 10'000'000));
  app.add_option("--owner-max-running", owner.running_jobs,
                 "jobs of one owner that run at once; more wait (default: 0, no limit)")
      ->check(CLI::Range(0, 1024));
  app.add_option("--owner-max-disk", owner_disk_mib_,
                 "MiB of results and journal at which no more jobs of their owner are taken (default: 0, no limit)")
      ->check(CLI::Range(0, 1 << 30));
  app.add_option("--owner-max-priority", owner.priority, "highest priority that jobs may have (default: 100)")
      ->check(CLI::Range(-100, 100));
}

void DaemonFlags::add_storage(CLI::App& app) {
  app.add_option("--data", options_.data_folder,
                 "folder of jobs and results (default: $XDG_DATA_HOME/cellcrush or ~/.local/share/cellcrush)");
  app.add_option("--min-free-disk", free_mib_,
                 "MiB that are kept free in the data folder: below it no job is taken and none runs (default: 256)")
      ->check(CLI::Range(0, 1 << 30));
  app.add_option("--keep-ended-jobs", keep_days_,
                 "days of the daemon's service for which an ended job or sweep is kept; time without a daemon does not "
                 "count (default: 0, for good)")
      ->check(CLI::Range(0.0, 36500.0));
  app.add_option("--keep-ended-count", options_.keep.count,
                 "ended jobs that are kept; those that ended first are deleted, sweeps as a whole (default: 0, all)")
      ->check(CLI::Range(0, 100'000'000));
  app.add_option("--keep-ended-size", keep_mib_,
                 "MiB of results and journal that ended jobs may take; those that ended first are deleted, sweeps as a "
                 "whole (default: 0, no limit)")
      ->check(CLI::Range(0, 1 << 30));
}

void DaemonFlags::add_times(CLI::App& app) {
  app.add_option("--checkpoint-interval", checkpoint_seconds_,
                 "seconds between two checkpoints of a running job (default: 60)")
      ->check(CLI::Range(0.01, 86400.0));
  app.add_option("--watch-patience", patience_seconds_,
                 "how long, in seconds, a watcher may stop reading before its stream is closed with RESOURCE_EXHAUSTED "
                 "(default: 600)")
      ->check(CLI::Range(1.0, 86400.0));
}

DaemonOptions DaemonFlags::options() const {
  DaemonOptions out = options_;
  out.access.certificate_scope = access::parse_scope(certificate_scope_).value();
  out.connections.memory_bytes = call_memory_mib_ * kMebibyte;
  out.limits.job_memory_bytes = memory_mib_ * kMebibyte;
  out.limits.free_disk_bytes = free_mib_ * kMebibyte;
  out.limits.job_time = std::chrono::duration<double>(job_seconds_);
  out.limits.owner.disk_bytes = owner_disk_mib_ * kMebibyte;
  out.keep.bytes = keep_mib_ * kMebibyte;
  out.keep.age = std::chrono::seconds(std::llround(86400.0 * keep_days_));
  out.checkpoint_interval = milliseconds_of(checkpoint_seconds_);
  out.watch_times.patience = milliseconds_of(patience_seconds_);
  return out;
}

}  // namespace cellcrush
