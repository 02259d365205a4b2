#pragma once

#include <chrono>
#include <filesystem>
#include <string>

#include "open_file.h"

namespace cellcrush::slurm {

/// What a task of a Slurm job is given.
struct TaskOptions {
  std::filesystem::path folder;              ///< the shared one
  std::string batch;                         ///< its name
  std::chrono::milliseconds lease{300'000};  ///< without contact to the daemon's folder, after which it leaves its job
  std::filesystem::path worker_program = "/proc/self/exe";
};

/// A folder on the node's own disk for one attempt, deleted at the end. A task that is killed leaves its folder: the
/// next task on the node removes it. A lock on the folder, which ends with the process, tells which tasks are alive.
class ScratchFolder {
 public:
  /// Creates a folder in `parent`, after it removed there what killed tasks of this user left. Throws ServiceError if
  /// the folder cannot be created.
  explicit ScratchFolder(const std::filesystem::path& parent);
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  OpenFile lock_;
};

/// Computes the attempts of one task of a batch, one after the other, on this node: `cellcrushd task`, in a script that
/// sbatch runs. Which task: $SLURM_ARRAY_TASK_ID, or the first. Each attempt runs in a folder on the node's disk
/// ($TMPDIR); its files are copied to the shared folder while it runs. SIGUSR2 announces the time limit, and SIGTERM
/// the end of the Slurm job: both leave the job at a checkpoint. Returns the exit code of the process. REQUIRES: no
/// other thread runs yet.
int run_task(const TaskOptions& options);

}  // namespace cellcrush::slurm
