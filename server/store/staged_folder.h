#pragma once

#include <filesystem>

#include "open_file.h"

namespace cellcrush::store {

/// A folder that appears complete or not at all. It is built beside its place as .NAME.partial and then renamed. The
/// next process deletes what a killed one left there. Not thread-safe.
class StagedFolder {
 public:
  /// Throws ServiceError: failed_precondition if `place` exists and is not an empty folder, if a running daemon owns
  /// it, or if another process is creating it; storage_full or internal if it cannot be created.
  explicit StagedFolder(const std::filesystem::path& place);
  /// Deletes the folder unless it was published.
  ~StagedFolder();
  StagedFolder(const StagedFolder&) = delete;
  StagedFolder& operator=(const StagedFolder&) = delete;

  /// Where to build the contents.
  [[nodiscard]] const std::filesystem::path& path() const { return partial_; }

  /// Makes the contents durable and renames the folder. Throws ServiceError: storage_full, internal, or
  /// failed_precondition if the place was taken meanwhile.
  void publish();

 private:
  std::filesystem::path place_;
  std::filesystem::path partial_;
  OpenFile lock_;  ///< the folder itself, open and locked
  bool published_ = false;
};

}  // namespace cellcrush::store
