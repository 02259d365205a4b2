#pragma once

#include <chrono>
#include <cstdint>
#include <vector>

namespace cellcrush::slurm {

/// What an attempt needs of a node, as predicted.
struct Need {
  int threads = 1;
  std::int64_t memory_mib = 0;
  double seconds = 0.0;  ///< of wall-clock time

  bool operator==(const Need&) const = default;
};

/// What sbatch asks for on behalf of an attempt whose run is predicted to take this much. Memory in steps, so that
/// attempts of one sweep share an array.
Need need_of(int threads, std::int64_t memory_bytes, double seconds);

/// Attempts, by index, that one task computes one after the other.
using Share = std::vector<std::size_t>;

/// Attempts that one sbatch submits: all tasks ask for the same threads and memory.
struct Pack {
  Need need;  ///< seconds: of the longest task
  std::vector<Share> tasks;
};

/// Distributes attempts over tasks, in their order. A task takes further attempts until it is predicted to run for
/// `task_length`: Slurm itself needs about half a second a task. At most `most_tasks` tasks a pack.
std::vector<Pack> pack(const std::vector<Need>& attempts, std::chrono::duration<double> task_length,
                       std::size_t most_tasks);

/// Time limit to ask for, in minutes: three times the prediction and ten minutes, at most `longest` unless that is 0.
std::int64_t time_limit_minutes(double seconds, std::chrono::seconds longest);

}  // namespace cellcrush::slurm
