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

// The errno for which files cannot be created, or a job's files cannot be used; 0 if there is none.
int error_of_folder(const JobFolder& folder) {
  for (const auto& path : {folder.order(), folder.claim(), folder.reports(), folder.checkpoint(),
                           folder.previous_checkpoint(), folder.partial_checkpoint(), folder.partial_result()}) {
    struct stat status {};
    if (lstat(path.c_str(), &status) != 0) {
      if (errno != ENOENT) return errno;
    } else if (!S_ISREG(status.st_mode)) {
      return EISDIR;
    } else if (::access(path.c_str(), R_OK | W_OK) != 0) {
      return errno;
    }
  }
  const auto probe = folder.root() / "probe";
  if (!OpenFile(open(probe.c_str(), O_WRONLY | O_CREAT | O_NONBLOCK | O_CLOEXEC, 0600))) return errno;
  return unlink(probe.c_str()) == 0 ? 0 : errno;
}

// False if there is no room.
bool keep_file(const std::filesystem::path& path, off_t bytes) {
  const OpenFile file(open(path.c_str(), O_WRONLY | O_CREAT | O_NONBLOCK | O_CLOEXEC, 0600));
  const int error = file ? posix_fallocate(file.get(), 0, bytes) : errno;
  if (error == 0) return true;
  unlink(path.c_str());
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
  std::error_code error;
  std::filesystem::remove(path, error);
  if (error) throw_file_error(path, "removed", error.value());
}

}  // namespace

std::optional<std::string> daemon_of(const std::filesystem::path& root) {
  const OpenFile lock(open((root / "lock").c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  if (!lock || flock(lock.get(), LOCK_SH | LOCK_NB) == 0 || errno != EWOULDBLOCK) return std::nullopt;
  return read_text(lock);
}

DataFolder::DataFolder(const std::filesystem::path& root) {
  make_private_folder(root);
  std::error_code error;
  root_ = std::filesystem::canonical(root, error);
  if (error) throw_file_error(root, "used", error.value());
  warn_of_readers(root_);
  make_private_folder(root_ / "jobs");
  const auto lock_path = root_ / "lock";
  lock_ = open_file(lock_path, O_RDWR | O_CREAT, "used");
  if (!lock_within(lock_, lock_path, kToEnd)) {
    throw ServiceError(ServiceError::Kind::failed_precondition,
                       "The data folder " + root_.string() + " is in use by a running daemon (process " +
                           read_text(lock_) + "). Stop that daemon, or use another folder with --data.");
  }
  if (free_bytes() < kStartBallastBytes) unlink(start_ballast().c_str());
  // Rewrites the first page before truncating the file: that needs no room.
  const std::string process = std::to_string(getpid());
  const auto written = pwrite(lock_.get(), process.data(), process.size(), 0);
  if (written < 0 ? errno != ENOSPC : ftruncate(lock_.get(), written) != 0) throw_file_error(lock_path, "used", errno);
}

void DataFolder::make_job_folder(std::int64_t job) const {
  const auto folder = job_folder(job);
  const auto error_of_job = [&folder] {
    return mkdir(folder.root().c_str(), 0700) != 0 && errno != EEXIST ? errno : error_of_folder(folder);
  };
  const int error = error_of_job();
  if (error == 0) return;
  const Shortage shortage = shortage_of_errno(error);
  if (shortage != Shortage::none && shortage != Shortage::data_folder) throw_file_error(folder.root(), "used", error);
  try_new_folder();
  set_aside(job, std::generic_category().message(error));
  if (const int again = error_of_job(); again != 0) throw_file_error(folder.root(), "used", again);
}

void DataFolder::try_new_folder() const {
  const auto path = root_ / "jobs" / ("probe-" + std::to_string(gettid()));
  const int error = mkdir(path.c_str(), 0700) == 0 || errno == EEXIST ? error_of_folder(JobFolder(path)) : errno;
  rmdir(path.c_str());
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
  for (const auto& path : {folder.partial_result(), folder.order(), folder.claim(), folder.partial_checkpoint(),
                           folder.previous_checkpoint(), folder.checkpoint(), folder.attempt()})
    remove_file(path);
  // Reports go last: they mark a folder that holds more than a result. Without a result, they are the job's history.
  std::error_code none;
  const bool is_history = has_reports(job) && !std::filesystem::exists(folder.result(), none) &&
                          !std::filesystem::exists(folder.history(), none);
  if (!is_history) return remove_file(folder.reports());
  std::error_code error;
  std::filesystem::rename(folder.reports(), folder.history(), error);
  const bool is_deleted = error == std::errc::no_such_file_or_directory;
  if (error && !is_deleted) throw_file_error(folder.reports(), "renamed", error.value());
}

bool DataFolder::has_reports(std::int64_t job) const {
  std::error_code none;
  const auto size = std::filesystem::file_size(job_folder(job).reports(), none);
  return !none && size > 0;
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

void DataFolder::give_up_ballast() const {
  std::error_code none;
  std::filesystem::remove(ballast(), none);
}

std::vector<std::int64_t> DataFolder::jobs_with_reports() const {
  std::vector<std::int64_t> out;
  for (const auto& name : names_in_jobs()) {
    const auto job = number_of("jobs/" + name);
    std::error_code none;
    if (job && std::filesystem::exists(job_folder(*job).reports(), none)) out.push_back(*job);
  }
  return out;
}

std::vector<std::string> DataFolder::names_in_jobs() const {
  std::vector<std::string> out;
  std::error_code error;
  for (std::filesystem::directory_iterator entry(root_ / "jobs", error), end; !error && entry != end;
       entry.increment(error))
    out.push_back(entry->path().filename().string());
  if (error) throw_file_error(root_ / "jobs", "read", error.value());
  return out;
}

std::filesystem::path DataFolder::set_aside(const std::string& name) const {
  const auto from = root_ / "jobs" / name;
  make_private_folder(root_ / "set-aside");
  // Moving a folder to another parent requires write permission in it.
  struct stat status {};
  if (lstat(from.c_str(), &status) == 0 && S_ISDIR(status.st_mode)) chmod(from.c_str(), status.st_mode | 0700U);
  for (int i = 1;; ++i) {
    auto to = root_ / "set-aside" / (name + (i == 1 ? "" : "." + std::to_string(i)));
    std::error_code error;
    if (std::filesystem::exists(std::filesystem::symlink_status(to, error))) continue;
    std::filesystem::rename(from, to, error);
    if (error) throw_file_error(from, "moved aside", error.value());
    return to;
  }
}

void DataFolder::remove_job_folder(std::int64_t job) const {
  const auto folder = job_folder(job).root();
  std::error_code error;
  // clean_job_folder() may be removing and renaming files of a run that has just ended.
  for (int tries = 0; tries < 100; ++tries) {
    std::filesystem::remove_all(folder, error);
    if (error != std::errc::no_such_file_or_directory && error != std::errc::directory_not_empty) break;
  }
  if (error) throw_file_error(folder, "used", error.value());
}

}  // namespace cellcrush::store
