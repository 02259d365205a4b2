#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "store/job_folder.h"
#include "worker/piece_file.h"

namespace cellcrush::slurm {

/// Copies what a run writes into another folder, while it runs: reports as they grow, each new checkpoint, and the
/// result. The copy keeps the order on which readers rely: a checkpoint comes after all reports before it, the last
/// report after the result.
/// Not thread-safe. Failures throw ServiceError; the next pass repeats what failed.
class Mirror {
 public:
  /// `reports_from`: size of the reports that `to` has already, at a boundary of two reports.
  Mirror(store::JobFolder from, store::JobFolder to, std::uint64_t reports_from)
      : from_(std::move(from)), to_(std::move(to)), offset_(reports_from) {}

  /// Copies what is new. Returns whether anything was.
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
  void put_checkpoint(worker::PieceReader& from) const;
  static std::optional<Version> version_of(const std::filesystem::path& path);

  store::JobFolder from_;
  store::JobFolder to_;
  std::uint64_t offset_;
  std::optional<Version> checkpoint_;
  std::optional<Version> result_;
};

/// Copies the files from which a worker resumes: reports and checkpoints. Throws ServiceError.
void copy_run(const store::JobFolder& from, const store::JobFolder& to);

/// 0 for a file that is not there.
std::uint64_t size_of(const std::filesystem::path& path);

}  // namespace cellcrush::slurm
