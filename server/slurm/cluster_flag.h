#pragma once

#include <string>

#include "jobs/executor_options.h"
#include "slurm/cluster_options.h"

namespace cellcrush::slurm {

/// Reads the value of the flag --slurm: "NAME:key=value,key=value", such as
/// "big:folder=/shared/cellcrush,sbatch=--partition=short". Keys: folder, program, commands, simd,
/// sbatch (may be repeated), jobs, tasks, task-length and longest (seconds). Throws std::invalid_argument with a
/// sentence that names the key, the value and the remedy.
ClusterOptions parse_cluster(const std::string& text);

/// The executor "slurm/NAME" of the cluster.
jobs::ExecutorOptions executor_of(const ClusterOptions& options);

}  // namespace cellcrush::slurm
