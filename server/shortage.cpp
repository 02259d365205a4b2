#include "shortage.h"

#include <cerrno>
#include <new>
#include <system_error>

#include "error.h"

namespace cellcrush {
namespace {

struct Words {
  const char* name;
  const char* remedy;
};

constexpr const char* kFreeSpace = "Free space on the data folder's disk, or delete jobs.";

// In the order of Shortage.
constexpr std::array<Words, 9> kWords = {{
    {"none", ""},
    {"low_disk", kFreeSpace},
    {"full_disk", kFreeSpace},
    {"descriptors", "Raise the daemon's limit on open files (ulimit -n, LimitNOFILE)."},
    {"memory", "Free memory, or raise the limits on memory and processes (ulimit -v, ulimit -u)."},
    {"data_folder", "Make the data folder readable and writable for the daemon's user."},
    {"journal", "Stop the program that locks journal.sqlite, and check the disk for faults."},
    {"worker", "Reinstall cellcrushd at the path it was started from, readable and executable."},
    {"cluster", "Check the cluster with sinfo, and the options of --slurm."},
}};

const Words& words_of(Shortage shortage) {
  const auto index = static_cast<std::size_t>(shortage);
  return kWords[index < kWords.size() ? index : 0];
}

}  // namespace

const char* name_of(Shortage shortage) { return words_of(shortage).name; }

const char* remedy_for(Shortage shortage) { return words_of(shortage).remedy; }

Shortage shortage_of_errno(int error) {
  switch (error) {
    case ENOSPC:
    case EDQUOT:
    case EFBIG: return Shortage::full_disk;
    case EMFILE:
    case ENFILE: return Shortage::descriptors;
    case ENOMEM:
    case EAGAIN: return Shortage::memory;
    case EACCES:
    case EPERM:
    case EROFS:
    case EIO:
    case ENOENT:
    case ENODEV:
    case ENXIO:
    case ENOLCK:
    case ESTALE:
    case ETIMEDOUT: return Shortage::data_folder;
    default: return Shortage::none;
  }
}

Trouble trouble_of(const std::exception& error) {
  if (const auto* refused = dynamic_cast<const ServiceError*>(&error)) return {refused->shortage(), error.what()};
  if (const auto* failed = dynamic_cast<const std::system_error*>(&error))
    return {shortage_of_errno(failed->code().value()), error.what()};
  if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr) return {Shortage::memory, "The daemon is out of memory."};
  return {};
}

}  // namespace cellcrush
