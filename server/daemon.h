#pragma once

#include <memory>
#include <string>
#include <vector>

#include "daemon_options.h"

namespace cellcrush {

/// The whole service in one object: serves from its construction to stop. Several may live in one process, each with a
/// data folder of its own.
class Daemon {
 public:
  /// Throws ServiceError when it cannot start: the data folder is taken, an address is in use or refused.
  explicit Daemon(DaemonOptions options);
  /// Stops.
  ~Daemon();
  Daemon(const Daemon&) = delete;
  Daemon& operator=(const Daemon&) = delete;

  /// What it listens on, with real ports, in the form of --listen.
  [[nodiscard]] const std::vector<std::string>& addresses() const;

  /// Where metrics are served, with the real port: "http://HOST:PORT/metrics"; empty: nowhere.
  [[nodiscard]] const std::string& metrics_url() const;

  /// Reads certificates and tokens again (Gate::read_files_again). Thread-safe.
  void read_files_again();

  /// Lets running workers leave their jobs at a checkpoint, closes watches and calls, within a few seconds. These jobs
  /// and those that wait are run by the next daemon on the same data folder. Safe to call twice.
  void stop();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace cellcrush
