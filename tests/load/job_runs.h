#pragma once

#include <cstdint>
#include <filesystem>

#include "cellcrush/v1/case.pb.h"

namespace cellcrush::load {

/// Jobs of one case that a daemon of its own runs, and what they cost it.
struct JobRuns {
  int jobs = 0;
  double makespan_s = 0.0;     ///< from the submit to the end of the last job
  double solver_s = 0.0;       ///< solver time of a job, mean
  double solver_spread = 0.0;  ///< its standard deviation, relative to the mean
  double daemon_s = 0.0;       ///< processor time of the daemon
  double journal_bytes = 0.0;
  double result_bytes = 0.0;
  double events = 0.0;  ///< states and samples
};

/// Starts a daemon with so many workers in `folder`, queues the jobs as one sweep over the seed, which changes nothing
/// in a case without imperfection, and waits for their end. Throws std::runtime_error if one does not succeed.
JobRuns run_jobs(const std::filesystem::path& folder, const v1::Case& submitted, int jobs, int workers);

/// Bytes of the pages in use of a journal, with what is in its log.
double journal_bytes_in(const std::filesystem::path& journal);

}  // namespace cellcrush::load
