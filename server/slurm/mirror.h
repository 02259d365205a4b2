#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "store/job_folder.h"

namespace cellcrush::slurm {

/// Copies what a run writes into another folder, while it runs: reports as they grow, each new checkpoint, and the
/// result. The copy keeps the order on which readers rely: a checkpoint comes after all reports before it, the last
/// report after the result.
/// Not thread-safe. Failures throw ServiceError; the next pass repeats what failed. Links are treated as absent.
class Mirror {
 public:
  /// `reports_from`: size of the reports that `to` has already, at a boundary of two reports. `most`: size limit of the
  /// result, of a checkpoint and of the reports to come.
  Mirror(store::JobFolder from, store::JobFolder to, std::uint64_t reports_from,
         std::uint64_t most = std::numeric_limits<std::uint64_t>::max());

  /// Copies what is new. Returns whether anything was. Throws ServiceError (exhausted) for a file beyond its limit.
  bool pass();

 private:
  /// Identifies a version of a file.
  struct Version {
    std::uint64_t inode = 0;
    std::int64_t size = 0;
    std::int64_t seconds = 0;
    std::int64_t nanoseconds = 0;
    bool operator==(const Version&) const = default;
  };
  bool put_result();
  void put_checkpoint() const;
  void require_room() const;
  static std::optional<Version> version_of(const std::filesystem::path& path);

  store::JobFolder from_;
  store::JobFolder to_;
  std::uint64_t start_;  ///< offset of the reports at the beginning
  std::uint64_t most_;
  std::chrono::system_clock::time_point since_;  ///< the reports before were copied
  std::uint64_t offset_;
  std::optional<Version> checkpoint_;
  std::optional<Version> result_;
};

/// Copies the files from which a worker resumes: reports and checkpoints. Throws ServiceError.
void copy_run(const store::JobFolder& from, const store::JobFolder& to);

/// 0 for a file that is not there.
std::uint64_t size_of(const std::filesystem::path& path);

}  // namespace cellcrush::slurm
