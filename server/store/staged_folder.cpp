#include "store/staged_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "error.h"
#include "store/data_folder.h"
#include "store/durable_file.h"
#include "store/file_lock.h"

namespace cellcrush::store {
namespace {

ServiceError refusal(const std::string& message) { return {ServiceError::Kind::failed_precondition, message}; }

void require_free(const std::filesystem::path& place) {
  std::error_code error;
  const auto status = std::filesystem::symlink_status(place, error);
  if (status.type() == std::filesystem::file_type::not_found) return;
  if (error) throw_file_error(place, "used", error.value());
  if (!std::filesystem::is_directory(status))
    throw refusal(place.string() + " exists and is not a folder. Give a new folder.");
  if (const auto owner = daemon_of(place)) {
    throw refusal(place.string() + " is in use by a running daemon (process " + *owner +
                  "). Give a new folder, and start the daemon on it.");
  }
  if (!std::filesystem::is_empty(place, error) && !error)
    throw refusal(place.string() + " is not empty. Give a new folder, or move this one away.");
  if (error) throw_file_error(place, "read", error.value());
}

std::filesystem::path partial_of(const std::filesystem::path& place) {
  return place.parent_path() / ("." + place.filename().string() + ".partial");
}

// Without a trailing slash, which would hide the name. The folders around it exist then, and may be named through
// links.
std::filesystem::path absolute_place(const std::filesystem::path& given) {
  auto place = std::filesystem::absolute(given).lexically_normal();
  if (!place.has_filename()) place = place.parent_path();
  std::error_code error;
  std::filesystem::create_directories(place.parent_path(), error);
  const auto parent = std::filesystem::canonical(place.parent_path(), error);
  if (error) throw_file_error(place.parent_path(), "used", error.value());
  return parent / place.filename();
}

void remove_content(const std::filesystem::path& folder) {
  for (const auto& name : names_in(folder)) {
    if (const int error = remove_own(folder / name); error != 0) throw_file_error(folder, "emptied", error);
  }
}

}  // namespace

StagedFolder::StagedFolder(const std::filesystem::path& place)
    : place_(absolute_place(place)), partial_(partial_of(place_)) {
  require_free(place_);
  if (const int error = make_own_folder(partial_); error != 0 && error != EEXIST)
    throw_file_error(partial_, "created", error);
  require_own_folder(partial_, partial_.string());
  lock_ = open_own(partial_, O_RDONLY | O_DIRECTORY, "used");
  if (!try_lock(lock_, partial_)) {
    throw refusal("Another process is creating " + place_.string() +
                  ". Wait until it is done, or give another folder.");
  }
  remove_content(partial_);
}

StagedFolder::~StagedFolder() {
  if (!published_) static_cast<void>(remove_own(partial_));
}

void StagedFolder::publish() {
  if (syncfs(lock_.get()) != 0) throw_file_error(partial_, "written", errno);
  // Replaces an empty folder only.
  if (const int reason = rename_own(partial_, place_); reason != 0) {
    if (reason == EBUSY || reason == EXDEV) {
      throw refusal(place_.string() + " is a mount point and cannot be replaced. Give a folder inside it.");
    }
    if (reason == ENOTEMPTY || reason == EEXIST)
      throw refusal(place_.string() + " was filled by another program in the meantime. Give a new folder.");
    throw_file_error(place_, "created", reason);
  }
  published_ = true;
  const OpenFile parent = open_own(place_.parent_path(), O_RDONLY | O_DIRECTORY);
  if (fsync(parent.get()) != 0) throw_file_error(place_, "written", errno);
}

}  // namespace cellcrush::store
