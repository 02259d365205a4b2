#include "store/data_folder.h"

#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <system_error>

#include "error.h"
#include "store/durable_file.h"

namespace cellcrush::store {
namespace {

constexpr off_t kBallastBytes = 4 * 1024 * 1024;
// SQLite's files and what a start writes.
constexpr off_t kStartBallastBytes = 512 * 1024;
constexpr std::int64_t kFullBelow = 64 * 1024;

void make_private_folder(const std::filesystem::path& path) {
  std::error_code error;
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), error);
  if (error) throw_file_error(path, "used", error.value());
  if (mkdir(path.c_str(), 0700) != 0 && errno != EEXIST) throw_file_error(path, "used", errno);
}

// The errno that keeps files from being made, or those of a job from being used; 0 where there is none.
int error_of_folder(const worker::JobFolder& folder) {
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
  const int file = open(probe.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  if (file < 0) return errno;
  close(file);
  return unlink(probe.c_str()) == 0 ? 0 : errno;
}

// False where there is no room.
bool keep_file(const std::filesystem::path& path, off_t bytes) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  const int error = file < 0 ? errno : posix_fallocate(file, 0, bytes);
  if (file >= 0) close(file);
  if (error == 0) return true;
  unlink(path.c_str());
  if (shortage_of_errno(error) != Shortage::full_disk) throw_file_error(path, "written", error);
  return false;
}

std::string read_text(int file) {
  std::array<char, 32> buffer{};
  const auto count = pread(file, buffer.data(), buffer.size(), 0);
  return count > 0 ? std::string(buffer.data(), static_cast<std::size_t>(count)) : "unknown";
}

}  // namespace

DataFolder::DataFolder(const std::filesystem::path& root) {
  make_private_folder(root);
  std::error_code error;
  root_ = std::filesystem::canonical(root, error);
  if (error) throw_file_error(root, "used", error.value());
  make_private_folder(root_ / "jobs");
  const auto lock_path = root_ / "lock";
  lock_ = open(lock_path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (lock_ < 0) throw_file_error(lock_path, "used", errno);
  if (flock(lock_, LOCK_EX | LOCK_NB) != 0) {
    const std::string owner = read_text(lock_);
    close(lock_);
    throw ServiceError(ServiceError::Kind::failed_precondition,
                       "The data folder " + root_.string() + " belongs to a daemon that runs (process " + owner +
                           "). Stop it, or give this one another folder with --data.");
  }
  if (free_bytes() < kStartBallastBytes) unlink(start_ballast().c_str());
  // The file's first page is written again before it is cut: that needs no room.
  const std::string process = std::to_string(getpid());
  const auto written = pwrite(lock_, process.data(), process.size(), 0);
  if (written < 0 ? errno != ENOSPC : ftruncate(lock_, written) != 0) {
    const int reason = errno;
    close(lock_);
    throw_file_error(lock_path, "used", reason);
  }
}

DataFolder::~DataFolder() { close(lock_); }

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
  const int error =
      mkdir(path.c_str(), 0700) == 0 || errno == EEXIST ? error_of_folder(worker::JobFolder(path)) : errno;
  rmdir(path.c_str());
  if (error == 0) return;
  const Shortage shortage = shortage_of_errno(error);
  throw ServiceError(shortage == Shortage::none ? Shortage::data_folder : shortage,
                     (root_ / "jobs").string() + " cannot be written: " + std::generic_category().message(error) + ".");
}

void DataFolder::set_aside(std::int64_t job, const std::string& reason) const {
  const auto from = job_folder(job).root();
  for (int i = 1;; ++i) {
    const std::filesystem::path to = from.string() + ".set-aside-" + std::to_string(i);
    if (renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) {
      spdlog::error("{} cannot be used ({}) and was set aside as {}. Look whether the disk is sound.", from.string(),
                    reason, to.filename().string());
      return;
    }
    if (errno != EEXIST) {
      throw ServiceError(ServiceError::Kind::internal,
                         from.string() + " cannot be used (" + reason +
                             ") and cannot be set aside: " + std::generic_category().message(errno) + ". Remove it.");
    }
  }
}

void DataFolder::clean_job_folder(std::int64_t job) const {
  const auto folder = job_folder(job);
  // The reports last: while they are there, the folder is known to hold more than a result.
  for (const auto& path : {folder.partial_result(), folder.order(), folder.claim(), folder.partial_checkpoint(),
                           folder.previous_checkpoint(), folder.checkpoint(), folder.reports()}) {
    std::error_code error;
    std::filesystem::remove(path, error);
    if (error) throw_file_error(path, "removed", error.value());
  }
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
  for (const auto& entry : std::filesystem::directory_iterator(root_ / "jobs")) {
    const std::string name = entry.path().filename();
    std::error_code unreadable;
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    if (!std::filesystem::exists(worker::JobFolder(entry.path()).reports(), unreadable)) continue;
    out.push_back(std::strtoll(name.c_str(), nullptr, 10));
  }
  return out;
}

void DataFolder::remove_job_folder(std::int64_t job) const {
  const auto folder = job_folder(job).root();
  std::error_code error;
  std::filesystem::remove_all(folder, error);
  if (error) throw_file_error(folder, "used", error.value());
}

}  // namespace cellcrush::store
