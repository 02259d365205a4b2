#pragma once

#include <array>
#include <exception>
#include <string>

namespace cellcrush {

/// What the daemon or its machine lacks for the moment. A shortage holds the queue (jobs/queue_hold.h) and ends no job.
enum class Shortage {
  none,
  low_disk,     ///< less room in the data folder than is to be kept free
  full_disk,    ///< no room left, or the quota is used up
  descriptors,  ///< too many open files, of this process or of the machine
  memory,       ///< no memory, or no process or thread more
  data_folder,  ///< the folder cannot be read or written
  journal,      ///< SQLite's file is locked or cannot be written
  worker,       ///< the worker program cannot be started
};

inline constexpr std::array kShortages = {Shortage::low_disk, Shortage::full_disk,   Shortage::descriptors,
                                          Shortage::memory,   Shortage::data_folder, Shortage::journal,
                                          Shortage::worker};

/// "full_disk".
const char* name_of(Shortage shortage);

/// What to do about it, a sentence.
const char* remedy_for(Shortage shortage);

/// The shortage that an errno stands for; none for other errors.
Shortage shortage_of_errno(int error);

/// A shortage that was met, and what failed, a sentence.
struct Trouble {
  Shortage shortage = Shortage::none;
  std::string reason;

  explicit operator bool() const { return shortage != Shortage::none; }
};

/// The shortage behind an exception: of a ServiceError, a std::system_error or a std::bad_alloc. None for others.
Trouble trouble_of(const std::exception& error);

}  // namespace cellcrush
