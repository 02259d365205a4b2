#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <stop_token>
#include <thread>

#include "store/sqlite.h"

namespace cellcrush::store {

/// Enables the return of free pages in a journal of an earlier version, unless it exceeds 256 MiB. This rewrites the
/// file and takes a second or two. A failure is logged and harmless. REQUIRES: no other connection is open.
void prepare_giving_back(Database& database);

/// Returns unused space of a journal to the disk, on a thread and connection of its own. Pages left free by deletions
/// go in pieces that hold up writers only for a moment; a WAL that a burst has extended is truncated. An operation
/// blocked by a reader or writer is retried at the next interval. Never throws.
class JournalUpkeep {
 public:
  /// Smaller WALs and free areas are left alone.
  static constexpr std::int64_t kKeptBytes = 16 * 1024 * 1024;

  /// REQUIRES: a Journal is open on the path for as long as this lives.
  JournalUpkeep(const std::filesystem::path& path, std::chrono::milliseconds interval);
  JournalUpkeep(const JournalUpkeep&) = delete;
  JournalUpkeep& operator=(const JournalUpkeep&) = delete;

  /// Whether the check of pages, indexes and references, made once, has found damage and logged it. Rows have checksums
  /// of their own (row_checksum.h).
  [[nodiscard]] bool has_found_damage() const { return damaged_; }

 private:
  void run(const std::stop_token& stop, std::chrono::milliseconds interval);
  void check();
  void give_back_pages(const std::stop_token& stop);
  void give_back_wal();

  std::filesystem::path wal_;
  Database database_;
  bool failing_ = false;
  std::atomic<bool> damaged_ = false;
  std::jthread thread_;
};

}  // namespace cellcrush::store
