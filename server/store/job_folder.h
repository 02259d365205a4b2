#pragma once

#include <filesystem>
#include <utility>

namespace cellcrush::store {

/// Contents of a job's folder: the result, and until the job has ended the files that worker and daemon share
/// (worker/job_folder.md).
class JobFolder {
 public:
  explicit JobFolder(std::filesystem::path root) : root_(std::move(root)) {}

  [[nodiscard]] const std::filesystem::path& root() const { return root_; }
  [[nodiscard]] std::filesystem::path order() const { return root_ / "order"; }
  /// The lattice of the order, if large (lattice_file.h), and the folder of those that are shared.
  [[nodiscard]] std::filesystem::path lattice() const { return root_ / "lattice"; }
  [[nodiscard]] std::filesystem::path lattices() const { return root_.parent_path().parent_path() / "lattices"; }
  [[nodiscard]] std::filesystem::path claim() const { return root_ / "worker"; }
  [[nodiscard]] std::filesystem::path reports() const { return root_ / "reports"; }
  /// The samples of an ended job whose result does not have them; as the reports.
  [[nodiscard]] std::filesystem::path history() const { return root_ / "history"; }
  [[nodiscard]] std::filesystem::path checkpoint() const { return root_ / "checkpoint"; }
  [[nodiscard]] std::filesystem::path previous_checkpoint() const { return root_ / "checkpoint.previous"; }
  [[nodiscard]] std::filesystem::path partial_checkpoint() const { return root_ / "checkpoint.partial"; }
  /// Which attempt computes the job in a cluster.
  [[nodiscard]] std::filesystem::path attempt() const { return root_ / "attempt"; }
  [[nodiscard]] std::filesystem::path result() const { return root_ / "result.h5"; }
  /// Written by the worker until the result is complete.
  [[nodiscard]] std::filesystem::path partial_result() const { return root_ / "result.h5.partial"; }

 private:
  std::filesystem::path root_;
};

}  // namespace cellcrush::store
