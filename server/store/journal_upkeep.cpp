#include "store/journal_upkeep.h"

#include <spdlog/spdlog.h>
#include <sqlite3.h>

#include <cstdint>
#include <string>
#include <system_error>

#include "error.h"
#include "pause.h"

namespace cellcrush::store {
namespace {

// Number of 4 KiB pages that one transaction moves.
constexpr const char* kSomePages = "PRAGMA incremental_vacuum(512)";
// How long a checkpoint waits for readers and writers, which it blocks meanwhile.
constexpr int kCheckpointPatience = 200;

constexpr std::int64_t kLargestRewritten = 256 * 1024 * 1024;

}  // namespace

void prepare_giving_back(Database& database) {
  constexpr std::int64_t kIncremental = 2;
  if (Statement(database, "PRAGMA auto_vacuum").number() == kIncremental) return;
  if (Statement(database, "PRAGMA page_count").number() * Statement(database, "PRAGMA page_size").number() >
      kLargestRewritten)
    return;
  try {
    database.execute("PRAGMA auto_vacuum=INCREMENTAL; VACUUM;");
  } catch (const std::exception& error) {
    spdlog::warn("The journal file does not shrink after deletions: {}", error.what());
  }
}

JournalUpkeep::JournalUpkeep(const std::filesystem::path& path, std::chrono::milliseconds interval)
    : wal_(path.string() + "-wal"),
      database_(path),
      thread_([this, interval](const std::stop_token& stop) { run(stop, interval); }) {}

void JournalUpkeep::run(const std::stop_token& stop, std::chrono::milliseconds interval) {
  for (bool checked = false; pause_unless_stopped(stop, interval);) {
    try {
      if (!checked) {
        const std::stop_callback interrupt(stop, [this] { sqlite3_interrupt(database_.raw()); });
        check();
        checked = true;
      }
      give_back_pages(stop);
      give_back_wal();
      failing_ = false;
    } catch (const std::exception& error) {
      if (!failing_ && !stop.stop_requested())
        spdlog::warn("The journal file could not be compacted and will be retried: {}", error.what());
      failing_ = true;
    }
  }
}

void JournalUpkeep::check() {
  std::string problem;
  try {
    Statement pages(database_, "PRAGMA integrity_check(1)");
    if (pages.step() && pages.bytes(0) != "ok") problem = pages.bytes(0);
    Statement references(database_, "PRAGMA foreign_key_check");
    if (references.step()) problem += " A row of " + references.bytes(0) + " refers to a missing one.";
  } catch (const ServiceError& error) {
    if (error.kind() != ServiceError::Kind::data_loss) throw;
    problem = error.what();
  }
  if (problem.empty()) return;
  damaged_ = true;
  spdlog::error("journal.sqlite is damaged: {} Lists may lack jobs. Run `cellcrushd verify`, and restore a backup.",
                problem);
}

void JournalUpkeep::give_back_pages(const std::stop_token& stop) {
  const std::int64_t page = Statement(database_, "PRAGMA page_size").number();
  while (!stop.stop_requested() && Statement(database_, "PRAGMA freelist_count").number() * page > kKeptBytes) {
    const std::int64_t before = Statement(database_, "PRAGMA page_count").number();
    {
      Statement vacuum(database_, kSomePages);
      while (vacuum.step()) continue;
    }
    // A journal of an earlier version cannot return its pages.
    if (Statement(database_, "PRAGMA page_count").number() >= before) return;
    give_back_wal();
  }
}

void JournalUpkeep::give_back_wal() {
  std::error_code none;
  const auto size = std::filesystem::file_size(wal_, none);
  if (none || static_cast<std::int64_t>(size) <= kKeptBytes) return;
  database_.set_patience(std::chrono::milliseconds(kCheckpointPatience));
  {
    // Returns whether somebody was in the way; the next interval then retries.
    Statement checkpoint(database_, "PRAGMA wal_checkpoint(TRUNCATE)");
    while (checkpoint.step()) continue;
  }
  database_.set_patience(Database::kPatience);
}

}  // namespace cellcrush::store
