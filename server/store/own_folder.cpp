#include "store/own_folder.h"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <linux/openat2.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <memory>
#include <system_error>

#include "error.h"
#include "store/durable_file.h"

namespace cellcrush::store {
namespace {

namespace fs = std::filesystem;

// A folder that another thread tidies up is emptied again.
constexpr int kTries = 100;

std::optional<struct stat> find_in(const OpenFile& folder, const std::string& name) {
  struct stat out {};
  if (!folder || fstatat(folder.get(), name.c_str(), &out, AT_SYMLINK_NOFOLLOW) != 0) return std::nullopt;
  return out;
}

// Opens an entry that is no link.
OpenFile open_in(const OpenFile& folder, const std::string& name, int flags) {
  if (!folder) return OpenFile();
  OpenFile out(openat(folder.get(), name.c_str(), flags | O_NOFOLLOW | O_CLOEXEC, 0600));
  if (out || errno != ENOTDIR) return out;
  const auto found = find_in(folder, name);
  errno = found && S_ISLNK(found->st_mode) ? ELOOP : ENOTDIR;
  return out;
}

// In one call where the kernel has it (Linux 5.6) and no sandbox forbids it.
OpenFile open_parent(const fs::path& path) {
  constexpr int kFlags = O_PATH | O_DIRECTORY;
  open_how how{};
  how.flags = kFlags | O_CLOEXEC;
  how.resolve = RESOLVE_NO_SYMLINKS;
  const fs::path parent = path.has_parent_path() ? path.parent_path() : ".";
  const auto opened = syscall(SYS_openat2, AT_FDCWD, parent.c_str(), &how, sizeof how);
  if (opened >= 0 || (errno != ENOSYS && errno != EPERM)) return OpenFile(static_cast<int>(opened));
  OpenFile out(open(path.is_absolute() ? "/" : ".", kFlags | O_CLOEXEC));
  for (const auto& part : path.relative_path().parent_path()) {
    if (out && !part.empty()) out = open_in(out, part, kFlags);
  }
  return out;
}

std::string last_of(const fs::path& path) { return path.filename().string(); }

// The errno, or 0.
int read_names(const OpenFile& folder, std::vector<std::string>& out) {
  const std::unique_ptr<DIR, int (*)(DIR*)> entries(fdopendir(fcntl(folder.get(), F_DUPFD_CLOEXEC, 0)), closedir);
  if (!entries) return errno;
  rewinddir(entries.get());
  errno = 0;
  while (const dirent* entry = readdir(entries.get())) {
    const std::string name = entry->d_name;
    if (name != "." && name != "..") out.push_back(name);
  }
  return errno;
}

int remove_in(const OpenFile& folder, const std::string& name, dev_t device) {
  if (unlinkat(folder.get(), name.c_str(), 0) == 0 || errno == ENOENT) return 0;
  if (errno != EISDIR) return errno;
  const OpenFile own = open_in(folder, name, O_RDONLY | O_DIRECTORY);
  struct stat status {};
  if (!own || fstat(own.get(), &status) != 0) return errno == ENOENT ? 0 : errno;
  if (status.st_dev != device) return EXDEV;
  for (int i = 0; i < kTries; ++i) {
    std::vector<std::string> names;
    if (const int error = read_names(own, names); error != 0) return error;
    for (const auto& each : names) {
      if (const int error = remove_in(own, each, device); error != 0) return error;
    }
    if (unlinkat(folder.get(), name.c_str(), AT_REMOVEDIR) == 0 || errno == ENOENT) return 0;
    if (errno != ENOTEMPTY && errno != EEXIST) return errno;
  }
  return ENOTEMPTY;
}

}  // namespace

fs::path canonical_of(const fs::path& given) {
  std::error_code error;
  auto out = fs::canonical(given, error);
  return error ? given : out;
}

OpenFile try_open_own(const fs::path& path, int flags, LastLink link) {
  const OpenFile parent = open_parent(path);
  const auto name = last_of(path);
  OpenFile out = open_in(parent, name, flags | O_NONBLOCK | O_NOCTTY);
  if (!out && errno == ELOOP && link == LastLink::of_owner) {
    const auto found = find_in(parent, name);
    errno = ELOOP;
    if (found && (found->st_uid == geteuid() || found->st_uid == 0))
      out = OpenFile(openat(parent.get(), name.c_str(), flags | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
  }
  if (!out && errno == ENXIO) errno = kNotRegular;
  struct stat status {};
  if (!out || (flags & O_DIRECTORY) != 0) return out;
  if (fstat(out.get(), &status) == 0 && S_ISREG(status.st_mode)) return out;
  static_cast<void>(out.close());
  errno = kNotRegular;
  return out;
}

std::optional<struct stat> find_own(const fs::path& path) { return find_in(open_parent(path), last_of(path)); }

bool is_own_file(const fs::path& path) {
  const auto found = find_own(path);
  return found && S_ISREG(found->st_mode);
}

int make_own_folder(const fs::path& path) {
  const OpenFile parent = open_parent(path);
  return parent && mkdirat(parent.get(), last_of(path).c_str(), 0700) == 0 ? 0 : errno;
}

int rename_own(const fs::path& from, const fs::path& to) {
  const OpenFile old_parent = open_parent(from);
  const OpenFile parent = old_parent ? open_parent(to) : OpenFile();
  if (!parent) return errno;
  const int failed = renameat(old_parent.get(), last_of(from).c_str(), parent.get(), last_of(to).c_str());
  return failed == 0 ? 0 : errno;
}

int remove_own(const fs::path& path) {
  const OpenFile parent = open_parent(path);
  struct stat status {};
  if (!parent || fstat(parent.get(), &status) != 0) return errno == ENOENT ? 0 : errno;
  return remove_in(parent, last_of(path), status.st_dev);
}

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> out;
  const OpenFile open = open_own(folder, O_RDONLY | O_DIRECTORY, "read");
  if (const int error = read_names(open, out); error != 0) throw_file_error(folder, "read", error);
  return out;
}

void require_own_folder(const fs::path& folder, const std::string& shown) {
  const OpenFile open = open_own(folder, O_RDONLY | O_DIRECTORY, "used");
  struct stat status {};
  if (fstat(open.get(), &status) != 0) throw_file_error(folder, "used", errno);
  std::string why;
  if (status.st_uid != geteuid() && status.st_uid != 0) {
    why = fmt::format("belongs to another user (uid {}). Name a folder of your own, or run chown {} {}.", status.st_uid,
                      geteuid(), folder.string());
  } else if ((status.st_mode & (S_IWGRP | S_IWOTH)) != 0) {
    why = fmt::format("has mode {:04o}: users other than its owner can write in it. Run chmod go-w {}",
                      status.st_mode & 07777U, folder.string());
  }
  if (!why.empty()) throw ServiceError(ServiceError::Kind::failed_precondition, shown + " " + why);
}

fs::path path_of(const OpenFile& file) { return "/proc/self/fd/" + std::to_string(file.get()); }

}  // namespace cellcrush::store
