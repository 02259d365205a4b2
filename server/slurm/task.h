#pragma once

#include <chrono>
#include <filesystem>
#include <string>

namespace cellcrush::slurm {

/// What a task of a Slurm job is given.
struct TaskOptions {
  std::filesystem::path folder;              ///< the shared one
  std::string batch;                         ///< its name
  std::chrono::milliseconds lease{300'000};  ///< without contact to the daemon's folder, after which it leaves its job
  std::filesystem::path worker_program = "/proc/self/exe";
};

/// Computes the attempts of one task of a batch, one after the other, on this node: `cellcrushd task`, in a script that
/// sbatch runs. Which task: $SLURM_ARRAY_TASK_ID, or the first. Each attempt runs in a folder on the node's disk
/// ($TMPDIR); its files are copied to the shared folder while it runs. SIGUSR2 announces the time limit, and SIGTERM
/// the end of the Slurm job: both leave the job at a checkpoint. Returns the exit code of the process. REQUIRES: no
/// other thread runs yet.
int run_task(const TaskOptions& options);

}  // namespace cellcrush::slurm
