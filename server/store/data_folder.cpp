#include "store/data_folder.h"

#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <system_error>
#include <thread>

#include "error.h"
#include "store/durable_file.h"
#include "store/file_lock.h"
#include "store/resource_name.h"

namespace cellcrush::store {
namespace {

constexpr std::chrono::milliseconds kToEnd{1000};
constexpr off_t kBallastBytes = 4 * 1024 * 1024;
// Room for SQLite's files and for the writes of a start.
constexpr off_t kStartBallastBytes = 512 * 1024;
constexpr std::int64_t kFullBelow = 64 * 1024;

void make_private_folder(const std::filesystem::path& path) {
  std::error_code error;
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), error);
  if (error) throw_file_error(path, "used", error.value());
  if (mkdir(path.c_str(), 0700) != 0 && errno != EEXIST) throw_file_error(path, "used", errno);
}

void make_folder_in_root(const std::filesystem::path& path) {
  if (const int error = make_own_folder(path); error != 0 && error != EEXIST) throw_file_error(path, "used", error);
  require_own_folder(path, "The folder " + path.string());
}

// The errno for which files cannot be created, or a job's files cannot be used; 0 if there is none.
int error_of_folder(const JobFolder& folder) {
  if (!try_open_own(folder.root(), O_RDONLY | O_DIRECTORY)) return errno;
  for (const auto& path : {folder.order(), folder.claim(), folder.reports(), folder.checkpoint(),
                           folder.previous_checkpoint(), folder.partial_checkpoint(), folder.partial_result()}) {
    const auto status = find_own(path);
    if (!status) {
      if (errno != ENOENT) return errno;
    } else if (!S_ISREG(status->st_mode)) {
      return S_ISLNK(status->st_mode) ? ELOOP : EISDIR;
    } else if (::access(path.c_str(), R_OK | W_OK) != 0) {
      return errno;
    }
  }
  const auto probe = folder.root() / "probe";
  if (!try_open_own(probe, O_WRONLY | O_CREAT)) return errno;
  return remove_own(probe);
}

// False if there is no room.
bool keep_file(const std::filesystem::path& path, off_t bytes) {
  const OpenFile file = try_open_own(path, O_WRONLY | O_CREAT);
  const int error = file ? posix_fallocate(file.get(), 0, bytes) : errno;
  if (error == 0) return true;
  static_cast<void>(remove_own(path));
  if (shortage_of_errno(error) != Shortage::full_disk) throw_file_error(path, "written", error);
  return false;
}

// An existing folder may be readable for others.
void warn_of_readers(const std::filesystem::path& root) {
  struct stat status {};
  if (stat(root.c_str(), &status) != 0 || (status.st_mode & 077U) == 0) return;
  spdlog::warn(
      "The data folder {} has mode {:04o}: other users of this machine can access its jobs and results. Run `chmod 700 "
      "{}`.",
      root.string(), status.st_mode & 07777U, root.string());
}

// An exiting daemon still holds the lock for a moment after it stops listening.
bool lock_within(const OpenFile& file, const std::filesystem::path& path, std::chrono::milliseconds limit) {
  const auto end = std::chrono::steady_clock::now() + limit;
  while (!try_lock(file, path)) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return true;
}

std::string read_text(const OpenFile& file) {
  std::array<char, 32> buffer{};
  const auto count = pread(file.get(), buffer.data(), buffer.size(), 0);
  return count > 0 ? std::string(buffer.data(), static_cast<std::size_t>(count)) : "unknown";
}

void remove_file(const std::filesystem::path& path) {
  if (const int error = remove_own(path); error != 0) throw_file_error(path, "removed", error);
}

}  // namespace

std::optional<std::string> daemon_of(const std::filesystem::path& root) {
  const OpenFile lock = try_open_own(root / "lock", O_RDONLY);
  if (!lock || flock(lock.get(), LOCK_SH | LOCK_NB) == 0 || errno != EWOULDBLOCK) return std::nullopt;
  return read_text(lock);
}

DataFolder::DataFolder(const std::filesystem::path& root) {
  make_private_folder(root);
  std::error_code error;
  root_ = std::filesystem::canonical(root, error);
  if (error) throw_file_error(root, "used", error.value());
  require_own_folder(root_, "The data folder " + root_.string());
  warn_of_readers(root_);
  make_folder_in_root(root_ / "jobs");
  const auto lock_path = root_ / "lock";
  lock_ = open_own(lock_path, O_RDWR | O_CREAT, "used");
  if (!lock_within(lock_, lock_path, kToEnd)) {
    throw ServiceError(ServiceError::Kind::failed_precondition,
                       "The data folder " + root_.string() + " is in use by a running daemon (process " +
                           read_text(lock_) + "). Stop that daemon, or use another folder with --data.");
  }
  if (free_bytes() < kStartBallastBytes) static_cast<void>(remove_own(start_ballast()));
  // Rewrites the first page before truncating the file: that needs no room.
  const std::string process = std::to_string(getpid());
  const auto written = pwrite(lock_.get(), process.data(), process.size(), 0);
  if (written < 0 ? errno != ENOSPC : ftruncate(lock_.get(), written) != 0) throw_file_error(lock_path, "used", errno);
}

void DataFolder::make_job_folder(std::int64_t job) const {
  const auto folder = job_folder(job);
  const auto error_of_job = [&folder] {
    const int error = make_own_folder(folder.root());
    return error != 0 && error != EEXIST ? error : error_of_folder(folder);
  };
  const int error = error_of_job();
  if (error == 0) return;
  const Shortage shortage = shortage_of_errno(error);
  if (shortage != Shortage::none && shortage != Shortage::data_folder) throw_file_error(folder.root(), "used", error);
  try_new_folder();
  set_aside(job, error == ELOOP ? "a symbolic link" : std::generic_category().message(error));
  if (const int again = error_of_job(); again != 0) throw_file_error(folder.root(), "used", again);
}

void DataFolder::try_new_folder() const {
  const auto path = root_ / "jobs" / ("probe-" + std::to_string(gettid()));
  const int made = make_own_folder(path);
  const int error = made == 0 || made == EEXIST ? error_of_folder(JobFolder(path)) : made;
  static_cast<void>(remove_own(path));
  if (error == 0) return;
  const Shortage shortage = shortage_of_errno(error);
  throw ServiceError(shortage == Shortage::none ? Shortage::data_folder : shortage,
                     (root_ / "jobs").string() + " cannot be written: " + std::generic_category().message(error) + ".");
}

void DataFolder::set_aside(std::int64_t job, const std::string& reason) const {
  const auto from = job_folder(job).root();
  const auto to = set_aside(from.filename().string());
  spdlog::error("{} cannot be used ({}) and was moved aside to {}. Check the disk for faults.", from.string(), reason,
                to.string());
}

void DataFolder::clean_job_folder(std::int64_t job) const {
  const auto folder = job_folder(job);
  for (const auto& path :
       {folder.partial_result(), folder.order(), folder.lattice(), folder.claim(), folder.partial_checkpoint(),
        folder.previous_checkpoint(), folder.checkpoint(), folder.attempt()})
    remove_file(path);
  // Reports go last: they mark a folder that holds more than a result. Without a result, they are the job's history.
  const bool is_history = has_reports(job) && !find_own(folder.result()) && !find_own(folder.history());
  if (!is_history) return remove_file(folder.reports());
  const int error = rename_own(folder.reports(), folder.history());
  const bool is_deleted = error == ENOENT;
  if (error != 0 && !is_deleted) throw_file_error(folder.reports(), "renamed", error);
}

bool DataFolder::has_reports(std::int64_t job) const {
  const auto status = find_own(job_folder(job).reports());
  return status && S_ISREG(status->st_mode) && status->st_size > 0;
}

void DataFolder::discard_run(std::int64_t job) const {
  clean_job_folder(job);
  for (const auto& path : {job_folder(job).result(), job_folder(job).history()}) remove_file(path);
}

std::int64_t DataFolder::free_bytes() const {
  std::error_code error;
  const auto space = std::filesystem::space(root_, error);
  if (error) throw_file_error(root_, "used", error.value());
  return static_cast<std::int64_t>(space.available);
}

bool DataFolder::keep_ballast() const {
  return keep_file(start_ballast(), kStartBallastBytes) && keep_file(ballast(), kBallastBytes);
}

bool DataFolder::is_full() const { return free_bytes() < kFullBelow; }

void DataFolder::give_up_ballast() const { static_cast<void>(remove_own(ballast())); }

std::vector<std::int64_t> DataFolder::jobs_with_reports() const {
  std::vector<std::int64_t> out;
  for (const auto& name : names_in_jobs()) {
    const auto job = number_of("jobs/" + name);
    std::error_code none;
    if (job && std::filesystem::exists(job_folder(*job).reports(), none)) out.push_back(*job);
  }
  return out;
}

std::vector<std::string> DataFolder::names_in_jobs() const { return names_in(root_ / "jobs"); }

std::filesystem::path DataFolder::set_aside(const std::string& name) const {
  const auto from = root_ / "jobs" / name;
  make_folder_in_root(root_ / "set-aside");
  // Moving a folder to another parent requires write permission in it.
  const auto status = find_own(from);
  if (status && S_ISDIR(status->st_mode)) chmod(from.c_str(), status->st_mode | 0700U);
  for (int i = 1;; ++i) {
    auto to = root_ / "set-aside" / (name + (i == 1 ? "" : "." + std::to_string(i)));
    if (find_own(to)) continue;
    if (const int error = rename_own(from, to); error != 0) throw_file_error(from, "moved aside", error);
    return to;
  }
}

void DataFolder::remove_job_folder(std::int64_t job) const {
  const auto folder = job_folder(job).root();
  const auto deleted = folder.string() + ".deleted";
  remove_file(deleted);
  if (const int error = rename_own(folder, deleted); error != 0 && error != ENOENT)
    throw_file_error(folder, "deleted", error);
  remove_file(deleted);
}

}  // namespace cellcrush::store
