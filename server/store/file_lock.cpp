#include "store/file_lock.h"

#include <fcntl.h>
#include <mntent.h>
#include <sys/file.h>

#include <cerrno>
#include <cstdio>
#include <memory>
#include <string>
#include <system_error>

#include "error.h"

namespace cellcrush::store {
namespace {

bool is_without_locks(int error) { return error == ENOLCK || error == ENOSYS || error == EOPNOTSUPP; }

// Such as "nfs, mounted at /home".
std::string file_system_of(const std::filesystem::path& path) {
  const std::unique_ptr<FILE, int (*)(FILE*)> mounts(setmntent("/proc/self/mounts", "r"), endmntent);
  std::string place;
  std::string type = "unknown";
  while (const mntent* mount = mounts ? getmntent(mounts.get()) : nullptr) {
    const std::string found = mount->mnt_dir;
    const bool is_above = path.string().starts_with(found.ends_with('/') ? found : found + '/');
    if (!is_above || found.size() < place.size()) continue;
    place = found;
    type = mount->mnt_type;
  }
  return type + ", mounted at " + place;
}

[[noreturn]] void refuse_file_system(const std::filesystem::path& path, int error) {
  std::error_code none;
  const auto folder = std::filesystem::weakly_canonical(path, none).parent_path();
  throw ServiceError(ServiceError::Kind::failed_precondition,
                     "The file system of " + folder.string() + " (" + file_system_of(folder) +
                         ") has no locks: " + std::generic_category().message(error) +
                         ". Use a folder on a local disk (cellcrushd --data, cellcrush run -o) and copy results from "
                         "there, or mount the file system with locks.");
}

}  // namespace

bool try_lock(const OpenFile& file, const std::filesystem::path& path) {
  if (flock(file.get(), LOCK_EX | LOCK_NB) != 0) {
    if (is_without_locks(errno)) refuse_file_system(path, errno);
    return false;
  }
  struct flock range {};
  range.l_type = F_RDLCK;
  if (fcntl(file.get(), F_GETLK, &range) != 0 && is_without_locks(errno)) refuse_file_system(path, errno);
  return true;
}

}  // namespace cellcrush::store
