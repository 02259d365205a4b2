#pragma once

#include <filesystem>

namespace cellcrush::slurm {

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
  int lock_ = -1;
};

}  // namespace cellcrush::slurm
