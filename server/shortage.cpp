#include "shortage.h"

#include <cerrno>
#include <new>
#include <system_error>

#include "error.h"

namespace cellcrush {

const char* name_of(Shortage shortage) {
  switch (shortage) {
    case Shortage::none: return "none";
    case Shortage::low_disk: return "low_disk";
    case Shortage::full_disk: return "full_disk";
    case Shortage::descriptors: return "descriptors";
    case Shortage::memory: return "memory";
    case Shortage::data_folder: return "data_folder";
    case Shortage::journal: return "journal";
    case Shortage::worker: return "worker";
    case Shortage::cluster: return "cluster";
  }
  return "none";
}

const char* remedy_for(Shortage shortage) {
  switch (shortage) {
    case Shortage::none: return "";
    case Shortage::low_disk:
    case Shortage::full_disk: return "Free space on the data folder's disk, or delete jobs.";
    case Shortage::descriptors: return "Raise the daemon's limit on open files (ulimit -n, LimitNOFILE).";
    case Shortage::memory: return "Free memory, or raise the limits on memory and processes (ulimit -v, ulimit -u).";
    case Shortage::data_folder: return "Make the data folder readable and writable for the daemon's user.";
    case Shortage::journal: return "Stop the program that locks journal.sqlite, and check the disk for faults.";
    case Shortage::cluster: return "Check the cluster with sinfo, and the options of --slurm.";
    case Shortage::worker: return "Reinstall cellcrushd at the path it was started from, readable and executable.";
  }
  return "";
}

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
