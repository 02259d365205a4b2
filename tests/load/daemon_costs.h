#pragma once

#include <map>
#include <string>

namespace cellcrush::load {

/// What a daemon's work costs, as deploy/scale/figures.csv has it. Times in seconds; `cpu`: processor time of the
/// daemon.
struct DaemonCosts {
  double job_cpu_s = 0.0;     ///< to queue, start and end a job, without its samples
  double sample_cpu_s = 0.0;  ///< to read a sample and make it durable
  double follow_cpu_s = 0.0;  ///< a second of following a running job, without its samples
  double watch_cpu_s = 0.0;   ///< to send an event to one watcher
  double slot_gap_s =
      0.0;  ///< that a slot holds a job beyond its solver: the worker starts, builds the mesh, seals the result
  double commit_s = 0.0;           ///< of a commit, without what it writes; the journal's turn is taken meanwhile
  double change_s = 0.0;           ///< of a change of state within a commit
  double sample_commit_s = 0.0;    ///< of a sample within a commit
  double job_journal_bytes = 0.0;  ///< of an ended job, without its samples
  double sample_journal_bytes = 0.0;
  double sample_result_bytes = 0.0;
  double job_result_bytes = 0.0;  ///< of a result, without its samples
  double waiting_journal_bytes = 0.0;
  double waiting_memory_bytes = 0.0;
  double small_run_s = 0.0;       ///< solver time of a small job (tests/server/small_case.h), with a core of its own
  double small_run_spread = 0.0;  ///< standard deviation relative to the mean
  double small_samples = 0.0;     ///< of it
};

/// The costs by name. Throws std::runtime_error that names a missing figure, and the remedy.
DaemonCosts costs_of(const std::map<std::string, double>& figures);

/// Reads a column of a table by the name in its first line, such as "median". Throws as costs_of.
DaemonCosts read_costs(const std::string& file, const std::string& column);

}  // namespace cellcrush::load
