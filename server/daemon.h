#pragma once

#include <memory>
#include <string>
#include <vector>

#include "daemon_options.h"

namespace cellcrush {

/// The whole service in one object: serves from construction to stop. One process may hold several, each with its own
/// data folder.
class Daemon {
 public:
  /// Throws ServiceError if it cannot start: the data folder is taken, or an address is in use or refused.
  explicit Daemon(DaemonOptions options);
  /// Stops.
  ~Daemon();
  Daemon(const Daemon&) = delete;
  Daemon& operator=(const Daemon&) = delete;

  /// The addresses it listens on, with actual ports, in the form of --listen.
  [[nodiscard]] const std::vector<std::string>& addresses() const;

  /// Where metrics are served, with the actual port: "http://HOST:PORT/metrics"; empty: nowhere.
  [[nodiscard]] const std::string& metrics_url() const;

  /// Where the API and the web page are served over HTTP, with the actual port: "http://HOST:PORT"; empty: nowhere.
  [[nodiscard]] const std::string& http_url() const;

  /// Rereads certificates and tokens (Gate::read_files_again). Thread-safe.
  void read_files_again();

  /// Has running workers checkpoint their jobs, and closes watches and calls, within a few seconds. The next daemon on
  /// the same data folder runs these jobs and the waiting ones. Safe to call twice.
  void stop();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace cellcrush
