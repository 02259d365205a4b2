#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "run_program.h"

namespace cellcrush::slurm {

/// What Slurm says of one task of a job: a line of squeue or sacct.
struct TaskReport {
  std::int64_t job = 0;  ///< of the array, for a task of one
  int task = -1;         ///< -1: not a task of an array
  std::string name;      ///< of the job
  std::string state;     ///< as Slurm calls it, such as "RUNNING"; newer versions have states not known here
  std::string reason;    ///< why it waits or ended, such as "Priority"; may be empty
  std::string node;      ///< may be empty
};

/// What became of a submission.
struct Submitted {
  std::optional<std::int64_t> job;  ///< nothing: it was refused, or its answer was lost
  bool is_refused = false;          ///< Slurm said that it does not take it
  std::string why;                  ///< what sbatch said, in one line
};

/// The commands of Slurm. Each is killed after a time limit. Thread-safe.
class Commands {
 public:
  /// `folder`: of the commands; empty: they are found by PATH.
  Commands(std::filesystem::path folder, std::chrono::milliseconds limit) : folder_(std::move(folder)), limit_(limit) {}

  /// Kills the commands that run, and all later ones.
  void stop() { stop_.request_stop(); }

  /// sbatch with these arguments.
  [[nodiscard]] Submitted sbatch(const std::vector<std::string>& arguments) const;

  /// All jobs of this user whose name begins with `prefix`, one entry for each task. Nothing if squeue failed; `why`
  /// then says why.
  [[nodiscard]] std::optional<std::vector<TaskReport>> squeue(const std::string& prefix, std::string& why) const;

  /// These jobs in the accounting. Nothing if sacct failed, as without accounting.
  [[nodiscard]] std::optional<std::vector<TaskReport>> sacct(const std::vector<std::int64_t>& jobs) const;

  /// Cancels a job, or one task of an array unless `task` is negative. Returns whether scancel succeeded.
  [[nodiscard]] bool scancel(std::int64_t job, int task) const;  // NOLINT(bugprone-easily-swappable-parameters)

 private:
  /// Does not throw: a command that cannot be started ends without an exit code.
  [[nodiscard]] ProgramEnd run(const char* command, std::vector<std::string> arguments) const;

  std::filesystem::path folder_;
  std::chrono::milliseconds limit_;
  std::stop_source stop_;
};

/// One line of squeue or sacct as Commands asks for it; nothing for another line.
std::optional<TaskReport> parse_squeue_line(const std::string& line);
std::optional<TaskReport> parse_sacct_line(const std::string& line);

/// What a state means for the task's work.
enum class Meaning {
  waits,      ///< it has not begun
  runs,       ///< it runs, or is suspended by Slurm
  ended,      ///< it ended by itself, well or not
  cancelled,  ///< somebody cancelled it
  displaced,  ///< it was preempted, its node failed, or Slurm starts it again
  timed_out,  ///< it reached its time limit
  no_memory,  ///< it used more memory than it asked for
  unknown,    ///< a state that is not known here
};
Meaning meaning_of(const std::string& state);

}  // namespace cellcrush::slurm
