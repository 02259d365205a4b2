#pragma once

#include <filesystem>

namespace cellcrush::store {

/// A folder that appears complete in its place or not at all. It is made beside it, as .NAME.partial, and renamed. What
/// a killed process left there is removed by the next one. Not thread-safe.
class StagedFolder {
 public:
  /// Throws ServiceError: failed_precondition when `place` is there and no empty folder, when a daemon that runs owns
  /// it, or when another process makes it now; storage_full or internal when it cannot be made.
  explicit StagedFolder(const std::filesystem::path& place);
  /// Removes what was not published.
  ~StagedFolder();
  StagedFolder(const StagedFolder&) = delete;
  StagedFolder& operator=(const StagedFolder&) = delete;

  /// Where it is filled.
  [[nodiscard]] const std::filesystem::path& path() const { return partial_; }

  /// Makes all in it durable and gives it its name. Throws ServiceError: storage_full, internal, or failed_precondition
  /// when the place was taken meanwhile.
  void publish();

 private:
  std::filesystem::path place_;
  std::filesystem::path partial_;
  int lock_ = -1;  ///< the folder itself, open and locked
  bool published_ = false;
};

}  // namespace cellcrush::store
