#include "store/data_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>

#include "error.h"
#include "store/durable_file.h"

namespace cellcrush::store {
namespace {

void make_private_folder(const std::filesystem::path& path) {
  std::error_code error;
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), error);
  if (error) throw_file_error(path, "used", error.value());
  if (mkdir(path.c_str(), 0700) != 0 && errno != EEXIST) throw_file_error(path, "used", errno);
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
  const std::string process = std::to_string(getpid());
  if (ftruncate(lock_, 0) != 0 || pwrite(lock_, process.data(), process.size(), 0) < 0) {
    const int reason = errno;
    close(lock_);
    throw_file_error(lock_path, "used", reason);
  }
}

DataFolder::~DataFolder() { close(lock_); }

void DataFolder::prepare_job_folder(std::int64_t job) const {
  remove_job_folder(job);
  const auto folder = job_folder(job);
  if (mkdir(folder.c_str(), 0700) != 0) throw_file_error(folder, "used", errno);
}

void DataFolder::remove_job_folder(std::int64_t job) const {
  const auto folder = job_folder(job);
  std::error_code error;
  std::filesystem::remove_all(folder, error);
  if (error) throw_file_error(folder, "used", error.value());
}

}  // namespace cellcrush::store
