#pragma once

#include <chrono>
#include <filesystem>
#include <stop_token>
#include <thread>

#include "store/sqlite.h"

namespace cellcrush::store {

/// Makes the journal of an earlier version, unless it is larger than 256 MiB, one whose free pages can be given back:
/// it is written again, which takes a second or two. What fails is named in the log and does no harm. REQUIRES: no
/// other connection is open.
void prepare_giving_back(Database& database);

/// Gives back what a journal needs no more, from a thread of its own with a connection of its own: pages that deletions
/// left free, in pieces that hold writers up for a moment only, and a WAL that a burst has made long. What a reader or
/// writer is in the way of is tried again at the next time. It never throws.
class JournalUpkeep {
 public:
  /// The WAL and the free pages are left alone below this.
  static constexpr std::int64_t kKeptBytes = 16 * 1024 * 1024;

  /// REQUIRES: a Journal has been opened on the path, and stays open as long as this lives.
  JournalUpkeep(const std::filesystem::path& path, std::chrono::milliseconds interval);
  JournalUpkeep(const JournalUpkeep&) = delete;
  JournalUpkeep& operator=(const JournalUpkeep&) = delete;

 private:
  void run(const std::stop_token& stop, std::chrono::milliseconds interval);
  void give_back_pages(const std::stop_token& stop);
  void give_back_wal();

  std::filesystem::path wal_;
  Database database_;
  bool failing_ = false;
  std::jthread thread_;
};

}  // namespace cellcrush::store
