#pragma once

#include <vector>

#include "cellcrush/v1/event.pb.h"
#include "cellcrush/v1/sweeps_service.pb.h"

namespace cellcrush::client::testing {

/// A job of the preset's kind with a title and a speed.
v1::Job make_job(v1::Job::State state);

/// Events of a run to its end in `state`: RUNNING, `samples` samples with progress between them, the end.
std::vector<v1::JobEvent> make_events(int samples, v1::Job::State state);

/// What the service of sweeps answers.
struct SweepScript {
  v1::Sweep sweep;  ///< known under its name, others are NOT_FOUND; without a name the service is UNIMPLEMENTED
  std::vector<v1::WatchSweepResponse> responses;  ///< of a watch, behind the snapshot
  int cut_streams = 0;                            ///< so many watches end with UNAVAILABLE
  std::size_t responses_before_cut = 5;           ///< of one watch
  bool hold = false;                              ///< a watch stays open behind the last response
  v1::SweepTable table;
  v1::Convergence convergence;
};

/// A sweep "sweeps/test" over speed, a job for each of `ends`: 50, 100, 150 ... m/s. Its jobs run one after the other
/// to these states; the table has plateaus of 0.3 + 0.0003 V^2 at the impact plate for those that succeed.
SweepScript make_sweep_script(const std::vector<v1::Job::State>& ends);

}  // namespace cellcrush::client::testing
