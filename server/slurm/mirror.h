#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "slurm/file_sink.h"
#include "store/job_folder.h"

namespace cellcrush::slurm {

/// Copies what a run writes, while it runs: reports as they grow, each new checkpoint, and the result. The copy keeps
/// the order on which readers rely: a checkpoint comes after all reports before it, the last report after the result.
/// Not thread-safe. Failures throw ServiceError; the next pass repeats what failed.
class Mirror {
 public:
  /// `reports_from`: size of the reports that the sink has already, at a boundary of two reports.
  Mirror(store::JobFolder from, FileSink& to, std::uint64_t reports_from)
      : from_(std::move(from)), to_(to), offset_(reports_from) {}

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
  static std::optional<Version> version_of(const std::filesystem::path& path);

  store::JobFolder from_;
  FileSink& to_;
  std::uint64_t offset_;
  std::optional<Version> checkpoint_;
  std::optional<Version> result_;
};

}  // namespace cellcrush::slurm
