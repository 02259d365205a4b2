#include "slurm/shared_folder.h"

#include <spdlog/spdlog.h>

#include <cerrno>
#include <optional>
#include <set>
#include <system_error>

#include "error.h"
#include "slurm/attempt_folder.h"
#include "slurm/batcher.h"
#include "slurm/small_file.h"
#include "store/durable_file.h"

namespace cellcrush::slurm {
namespace {

namespace fs = std::filesystem;

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) store::throw_file_error(folder, "used", error.value());
}

[[noreturn]] void refuse_folder(const std::string& why) {
  throw ServiceError(ServiceError::Kind::failed_precondition, why);
}

// The ids of the attempts that jobs name.
std::set<std::string> named_attempts(const fs::path& data_folder) {
  std::set<std::string> out;
  std::error_code error;
  for (fs::directory_iterator entry(data_folder / "jobs", error), end; !error && entry != end; entry.increment(error)) {
    if (const auto attempt = read_attempt(store::JobFolder(entry->path()))) out.insert(attempt->id());
  }
  // Attempts are not to be taken for left ones because their jobs could not be read.
  if (error && error != std::errc::no_such_file_or_directory)
    store::throw_file_error(data_folder / "jobs", "read", error.value());
  return out;
}

template <typename IsUsed>
void remove_unused(const fs::path& folder, const IsUsed& is_used) {
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    if (is_used(entry->path())) continue;
    std::error_code ignored;
    fs::remove_all(entry->path(), ignored);
    spdlog::info("{} was left by an earlier daemon and is removed", entry->path().string());
  }
}

}  // namespace

void require_marker(const fs::path& folder) {
  if (read_small_file(folder / kMarker)) return;
  store::throw_file_error(folder, "used", ENODEV);
}

void prepare_shared_folder(const ClusterOptions& options, const fs::path& data_folder) {
  const fs::path own = data_folder / "slurm" / options.name / "identity";
  const auto marker = options.folder / kMarker;
  const auto expected = read_small_file(own);
  const auto found = read_small_file(marker);
  const std::string name = "--slurm " + options.name + ": " + options.folder.string();
  if (expected && !found)
    refuse_folder(name + " lacks the file " + kMarker +
                  " that this daemon wrote. Mount its file system; if you emptied "
                  "the folder, delete " +
                  own.string() + ".");
  if (found && found != expected)
    refuse_folder(name +
                  " belongs to a daemon with another data folder. Give each daemon a folder of its own; if that "
                  "daemon is no more, delete " +
                  marker.string() + ".");
  make_folder(own.parent_path());
  make_folder(options.folder / "attempts");
  make_folder(options.folder / "batches");
  if (!found) {
    const std::string identity = random_name();
    write_small_file(own, identity);
    write_small_file(marker, identity);
  }
  const auto named = named_attempts(data_folder);
  remove_unused(options.folder / "attempts", [&](const fs::path& path) { return named.contains(path.filename()); });
  remove_unused(options.folder / "batches", [&](const fs::path& path) {
    const auto batch = read_message<Batch>(path / "tasks");
    if (!batch) return false;
    for (const auto& task : batch->tasks()) {
      for (const auto& id : task.attempts()) {
        if (named.contains(id)) return true;
      }
    }
    return false;
  });
}

}  // namespace cellcrush::slurm
