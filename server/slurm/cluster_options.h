#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "jobs/executor.h"

namespace cellcrush::slurm {

/// How the daemon uses one Slurm cluster. Names of options are those of the flag --slurm (parse_cluster).
struct ClusterOptions {
  std::string name;                      ///< the executor is called "slurm/NAME"
  std::filesystem::path folder;          ///< absolute; on a file system that the daemon and all nodes share
  std::filesystem::path named_folder;    ///< the same with its links, for the nodes; `folder` has none in the executor
  std::filesystem::path program;         ///< cellcrushd on the nodes, absolute; empty: the daemon's own path
  std::filesystem::path commands;        ///< folder of sbatch, squeue, sacct and scancel; empty: found by PATH
  std::string simd;                      ///< CELLCRUSH_SIMD of the tasks; empty: the fastest kernel of each node
  std::vector<std::string> sbatch;       ///< further options of sbatch, such as "--partition=short"
  int jobs = 256;                        ///< jobs that are in the cluster at once
  int tasks = 64;                        ///< tasks of one array that run at once
  std::chrono::seconds task_length{60};  ///< predicted time up to which short jobs share a task
  std::chrono::seconds longest{0};       ///< limit for the time limit of a task; 0: none

  /// Times, replaceable in tests.
  struct Times {
    std::chrono::milliseconds look{1'000};         ///< between two readings of an attempt's folder
    std::chrono::milliseconds squeue{30'000};      ///< between two calls of squeue
    std::chrono::milliseconds command{60'000};     ///< after which a command of Slurm is killed
    std::chrono::milliseconds silent{30'000};      ///< without a heartbeat, after which Slurm is asked
    std::chrono::milliseconds lease{300'000};      ///< without a heartbeat, after which a task stops by itself
    std::chrono::milliseconds leave{60'000};       ///< for a task to leave or end its job
    std::chrono::milliseconds unanswered{60'000};  ///< for a submission without an answer to show up
  };
  Times times;
};

/// Reads the value of the flag --slurm: "NAME:key=value,key=value", such as
/// "big:folder=/shared/cellcrush,sbatch=--partition=short". Keys: folder, program, commands, simd,
/// sbatch (may be repeated), jobs, tasks, task-length and longest (seconds). Throws std::invalid_argument with a
/// sentence that names the key, the value and the remedy.
ClusterOptions parse_cluster(const std::string& text);

/// The executor "slurm/NAME" of the cluster.
jobs::ExecutorOptions executor_of(const ClusterOptions& options);

}  // namespace cellcrush::slurm
