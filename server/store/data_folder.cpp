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

constexpr off_t kBallastBytes = 4 * 1024 * 1024;

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

void DataFolder::make_job_folder(std::int64_t job) const { make_private_folder(job_folder(job).root()); }

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

void DataFolder::keep_ballast() const {
  const int file = open(ballast().c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  if (file < 0) return;
  const bool made = posix_fallocate(file, 0, kBallastBytes) == 0;
  close(file);
  if (!made) give_up_ballast();
}

void DataFolder::give_up_ballast() const {
  std::error_code none;
  std::filesystem::remove(ballast(), none);
}

std::vector<std::int64_t> DataFolder::jobs_with_reports() const {
  std::vector<std::int64_t> out;
  for (const auto& entry : std::filesystem::directory_iterator(root_ / "jobs")) {
    if (!std::filesystem::exists(worker::JobFolder(entry.path()).reports())) continue;
    out.push_back(std::strtoll(entry.path().filename().c_str(), nullptr, 10));
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
