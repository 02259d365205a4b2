#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "slurm/attempt.pb.h"
#include "slurm/cluster_options.h"
#include "store/job_folder.h"

namespace cellcrush::slurm {

/// A file in a cluster's folder. Without it the folder's file system is not mounted.
inline constexpr const char* kMarker = "cellcrush-folder";

/// The folder attempts/ID on the shared file system, with which the daemon and one task communicate
/// (attempt_folder.md). Failures throw ServiceError, with the shortage if there is one.
class AttemptFolder {
 public:
  explicit AttemptFolder(std::filesystem::path root) : root_(std::move(root)) {}
  /// That of an attempt in the folder of a cluster. Throws ServiceError (data_loss) for an id that is no name in it.
  AttemptFolder(const std::filesystem::path& shared, const std::string& id);

  [[nodiscard]] const std::filesystem::path& root() const { return root_; }
  /// order, reports, checkpoint, checkpoint.previous and result.h5, named as in a job's folder.
  [[nodiscard]] store::JobFolder files() const { return store::JobFolder(root_); }

  /// Whether the folder is there. Throws ServiceError if that cannot be told: the file system is not mounted or does
  /// not answer.
  [[nodiscard]] bool exists() const;

  /// Opens the folder, so that NFS looks again for files that were absent.
  void look_again() const;

  /// Creates the claim. False if there is one, or if the folder is gone: the attempt is then another's. Atomic among
  /// all machines that share the file system.
  [[nodiscard]] bool claim(const Claim& claim) const;
  [[nodiscard]] std::optional<Claim> find_claim() const;

  /// A sign of life: a number that differs from the one before. Needs no room on the disk after the first.
  void beat(std::uint64_t number) const;
  /// Nothing if there was none.
  [[nodiscard]] std::optional<std::uint64_t> last_beat() const;

  /// Writes in place: other machines then read the new bytes of a file that they know.
  void request(Request::Kind kind) const;
  /// ABANDON if the folder is gone.
  [[nodiscard]] Request::Kind requested() const;

  void end(const Ended& ended) const;
  [[nodiscard]] std::optional<Ended> find_ended() const;

  /// Deletes the folder. Does not throw.
  void remove() const;

 private:
  [[nodiscard]] std::filesystem::path file(const char* name) const { return root_ / name; }

  std::filesystem::path root_;
};

/// Prepares the folder of a cluster for the daemon with this data folder: a marker in both says that they belong
/// together. Removes what earlier daemons left of attempts that no job names; entries with other names stay. Throws
/// ServiceError (failed_precondition) if the folder belongs to another daemon or user, if others can write in it, or if
/// it lacks its marker, as when its file system is not mounted.
void prepare_shared_folder(const ClusterOptions& options, const std::filesystem::path& data_folder);

/// Throws ServiceError, with a shortage, unless the marker is there.
void require_marker(const std::filesystem::path& folder);

/// The file `attempt` of a job's folder.
void write_attempt(const store::JobFolder& job, const Attempt& attempt);
std::optional<Attempt> read_attempt(const store::JobFolder& job);

}  // namespace cellcrush::slurm
