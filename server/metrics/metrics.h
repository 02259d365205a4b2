#pragma once

#include <cstddef>
#include <memory>

#include "cellcrush/v1/job.pb.h"
#include "cellcrush/v1/sample.pb.h"
#include "listen_address.h"

namespace cellcrush::metrics {

/// Numbers about the daemon for Prometheus, in its text format at http://HOST:PORT/metrics.
///
///   cellcrush_jobs_waiting, cellcrush_jobs_running   jobs now
///   cellcrush_jobs_ended_total{state="SUCCEEDED"}    since the daemon's start, by the state in which they ended
///   cellcrush_steps_total                            time steps of ended jobs that left a result
///   cellcrush_stage_seconds_total{stage="..."}       their processor time by stage of a step (the fields of StageTimes)
///
/// Thread-safe.
class Metrics {
 public:
  Metrics();
  ~Metrics();
  Metrics(const Metrics&) = delete;
  Metrics& operator=(const Metrics&) = delete;

  /// Serves them from now on, on an address of kind tcp. Returns the address with its real port. Throws ServiceError
  /// (failed_precondition) when it is in use. To be called once.
  ListenAddress serve(const ListenAddress& address);

  void set_jobs(std::size_t waiting, std::size_t running);

  /// `summary` is null for a job without a result.
  void count_ended(v1::JobState state, const v1::Summary* summary);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace cellcrush::metrics
