#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace cellcrush {

// What of this machine this process may use. Each reads /proc and /sys below `root`.

struct Cores {
  int count = 1;
  std::string limit;  ///< what leaves fewer than the machine has: "affinity", "cgroup quota", "Slurm"; or empty

  /// "2 cores", "1 core (affinity)".
  [[nodiscard]] std::string text() const;
};

/// The fewest of: the machine's cores, the affinity (taskset, cpusets), the quota of this process's control group and
/// of those above it (versions 1 and 2; a part of a core counts as one), and what Slurm has given its job on this node
/// (SLURM_CPUS_ON_NODE).
Cores usable_cores(const std::filesystem::path& root = "/");

/// Bytes: the machine's memory, or the limit of the control group or of one above it.
std::int64_t usable_memory(const std::filesystem::path& root = "/");

}  // namespace cellcrush
