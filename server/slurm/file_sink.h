#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>

#include "store/job_folder.h"

namespace cellcrush::slurm {

/// Where a Mirror puts the files of a run. Each call may be repeated. Failures throw ServiceError, with the shortage if
/// there is one.
class FileSink {
 public:
  virtual ~FileSink() = default;

  /// Writes bytes of the reports at this offset, which is at most their present size.
  virtual void write_reports(std::uint64_t offset, const std::string& bytes) = 0;

  /// Replaces the checkpoint once all reports written before are durable. The checkpoint before becomes
  /// checkpoint.previous.
  virtual void put_checkpoint(const std::string& bytes) = 0;

  /// Puts a durable copy of this result.
  virtual void put_result(const std::filesystem::path& file) = 0;
};

/// Puts them into a job's folder.
class FolderSink final : public FileSink {
 public:
  explicit FolderSink(store::JobFolder folder) : folder_(std::move(folder)) {}

  void write_reports(std::uint64_t offset, const std::string& bytes) override;
  void put_checkpoint(const std::string& bytes) override;
  void put_result(const std::filesystem::path& file) override;

 private:
  store::JobFolder folder_;
};

/// Copies a file durably under its final name. Throws ServiceError.
void copy_durably(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace cellcrush::slurm
