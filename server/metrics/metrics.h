#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "cellcrush/v1/job.pb.h"
#include "cellcrush/v1/sample.pb.h"
#include "listen_address.h"
#include "shortage.h"

namespace cellcrush::metrics {

/// What is measured when it is asked for: the queue, the disk and the owners now.
struct Standing {
  struct Owner {
    std::size_t waiting = 0;  ///< jobs
    std::size_t running = 0;
    std::int64_t bytes = 0;  ///< journal rows, and results of ended jobs
  };

  double queue_age_s = 0.0;  ///< for which a job has waited in this daemon, at most
  std::int64_t free_disk_bytes = 0;
  std::int64_t kept_disk_bytes = 0;  ///< below which no job starts
  std::map<std::string, Owner> owners{};
  std::map<std::string, std::int64_t> behind{};  ///< changes that a receiver of notices has not seen, by its name
};

/// Prometheus metrics of the daemon, in text format at http://HOST:PORT/metrics (monitor.md lists them). Thread-safe.
class Metrics {
 public:
  Metrics();
  ~Metrics();
  Metrics(const Metrics&) = delete;
  Metrics& operator=(const Metrics&) = delete;

  /// Starts serving on an address of kind tcp. Returns the address with its actual port. Throws ServiceError
  /// (failed_precondition) if it is in use. Call once.
  ListenAddress serve(const ListenAddress& address);

  /// Asked at each scrape, on its thread; null: not any more, once a scrape that asks has ended. May throw.
  void ask(std::function<Standing()> standing);

  /// Jobs of one executor.
  void set_jobs(const std::string& executor, std::size_t waiting, std::size_t running);

  /// The shortages that hold a queue now.
  void set_holds(const std::set<Shortage>& holds);

  /// Whether the journal has lost changes or was found damaged.
  void set_journal_damaged(bool damaged);

  void set_speed(std::int64_t job, double steps_per_second);
  void observe_commit(double seconds);
  void observe_event(double seconds);
  void count_watcher(int change);
  void set_connections(std::size_t open);
  void count_refused_connection();
  void count_skipped_frames(int frames);

  /// `cause`: of a FAILED job. `summary` is null for a job without a result.
  void count_ended(v1::Job::State state, v1::Job::Cause cause, const v1::Summary* summary);

  /// A run that succeeded without interruption: what it took and what was predicted for it, both positive.
  void observe_run(double seconds, double predicted_seconds);  // NOLINT(bugprone-easily-swappable-parameters)

  /// A call that has ended. `method`: "Jobs/CreateJob"; `code`: of gRPC, "OK"; `seconds`: nothing for a stream.
  void count_call(const std::string& method, const std::string& code, std::optional<double> seconds);

  /// The daemon has this device.
  void set_device(const std::string& device);
  /// A run has ended that the device has advanced, or left to the processor.
  void count_device_run(bool advanced);

  enum class Notice { delivered, retried, dropped };
  /// Adds notices to a receiver's count; 0 makes its series.
  void count_notices(const std::string& target, Notice result, int count);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace cellcrush::metrics
