#pragma once

#include <array>
#include <exception>
#include <string>

namespace cellcrush {

/// A resource that the daemon or its machine temporarily lacks. A shortage holds the queue (jobs/queue_hold.h) and ends
/// no job.
enum class Shortage {
  none,
  low_disk,     ///< free room in the data folder is below the limit
  full_disk,    ///< the disk is full, or the quota is used up
  descriptors,  ///< too many open files in this process or on this machine
  memory,       ///< no memory, or no process or thread available
  data_folder,  ///< the folder is unreadable or not writable
  journal,      ///< the SQLite file is locked or not writable
  worker,       ///< the worker program cannot start
  cluster,      ///< the cluster takes no jobs
};

inline constexpr std::array kShortages = {Shortage::low_disk, Shortage::full_disk,   Shortage::descriptors,
                                          Shortage::memory,   Shortage::data_folder, Shortage::journal,
                                          Shortage::worker,   Shortage::cluster};

/// "full_disk".
const char* name_of(Shortage shortage);

/// How to end the shortage, as a sentence.
const char* remedy_for(Shortage shortage);

/// The shortage that an errno means; none for other errors.
Shortage shortage_of_errno(int error);

/// A shortage, and what failed, as a sentence.
struct Trouble {
  Shortage shortage = Shortage::none;
  std::string reason;

  explicit operator bool() const { return shortage != Shortage::none; }
};

/// The shortage behind a ServiceError, std::system_error or std::bad_alloc; none for other exceptions.
Trouble trouble_of(const std::exception& error);

}  // namespace cellcrush
