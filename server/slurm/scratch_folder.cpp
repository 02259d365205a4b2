#include "slurm/scratch_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <climits>
#include <cstdlib>
#include <string>
#include <system_error>

#include "store/durable_file.h"

namespace cellcrush::slurm {
namespace {

namespace fs = std::filesystem;

// The locks of a network file system may not reach other nodes, so each node has names of its own.
std::string prefix_of_node() {
  std::array<char, HOST_NAME_MAX + 1> host{};
  gethostname(host.data(), host.size() - 1);
  return std::string("cellcrush-task-") + host.data() + "@";
}

int open_folder(const fs::path& path) { return open(path.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC); }

bool is_own(int folder) {
  struct stat status {};
  return fstat(folder, &status) == 0 && status.st_uid == geteuid();
}

// Another task may have taken the new folder for a left one, in the instant before it was locked.
bool still_exists(int folder, const fs::path& path) {
  struct stat opened {};
  struct stat found {};
  return fstat(folder, &opened) == 0 && stat(path.c_str(), &found) == 0 && opened.st_ino == found.st_ino;
}

void remove_left_folders(const fs::path& parent, const std::string& prefix) {
  std::error_code ignored;
  for (auto entry = fs::directory_iterator(parent, ignored); entry != fs::directory_iterator();
       entry.increment(ignored)) {
    if (!entry->path().filename().string().starts_with(prefix)) continue;
    const int folder = open_folder(entry->path());
    if (folder < 0) continue;
    std::error_code failed;
    if (is_own(folder) && flock(folder, LOCK_EX | LOCK_NB) == 0) fs::remove_all(entry->path(), failed);
    close(folder);
  }
}

}  // namespace

ScratchFolder::ScratchFolder(const fs::path& parent) {
  const std::string prefix = prefix_of_node();
  remove_left_folders(parent, prefix);
  while (lock_ < 0) {
    std::string name = (parent / prefix).string() + "XXXXXX";
    if (mkdtemp(name.data()) == nullptr) store::throw_file_error(name, "created", errno);
    path_ = name;
    const int folder = open_folder(path_);
    if (folder < 0 && errno == ENOENT) continue;
    if (folder < 0) {
      const int error = errno;
      rmdir(name.c_str());
      store::throw_file_error(path_, "used", error);
    }
    // On a file system without locks, nobody takes a folder for a left one.
    static_cast<void>(flock(folder, LOCK_EX));
    if (still_exists(folder, path_))
      lock_ = folder;
    else
      close(folder);
  }
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
  close(lock_);
}

}  // namespace cellcrush::slurm
