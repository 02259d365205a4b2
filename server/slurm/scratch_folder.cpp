#include "slurm/scratch_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <string>
#include <string_view>
#include <system_error>

#include "store/durable_file.h"

namespace cellcrush::slurm {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPrefix = "cellcrush-task-";

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

void remove_left_folders(const fs::path& parent) {
  std::error_code ignored;
  for (auto entry = fs::directory_iterator(parent, ignored); entry != fs::directory_iterator();
       entry.increment(ignored)) {
    if (!entry->path().filename().string().starts_with(kPrefix)) continue;
    const int folder = open_folder(entry->path());
    if (folder < 0) continue;
    std::error_code failed;
    if (is_own(folder) && flock(folder, LOCK_EX | LOCK_NB) == 0) fs::remove_all(entry->path(), failed);
    close(folder);
  }
}

}  // namespace

ScratchFolder::ScratchFolder(const fs::path& parent) {
  remove_left_folders(parent);
  while (lock_ < 0) {
    std::string name = (parent / kPrefix).string() + "XXXXXX";
    if (mkdtemp(name.data()) == nullptr) store::throw_file_error(name, "created", errno);
    path_ = name;
    const int folder = open_folder(path_);
    if (folder < 0 && errno == ENOENT) continue;
    if (folder < 0 || flock(folder, LOCK_EX) != 0) store::throw_file_error(path_, "used", errno);
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
