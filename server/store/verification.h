#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "store/sample_reader.h"
#include "store/sqlite.h"

namespace cellcrush::store {

/// Result of checking every row of a journal.
struct JournalFindings {
  std::vector<std::string> problems;      ///< one or two sentences each, with the remedy
  std::vector<std::int64_t> with_result;  ///< ended jobs with a summary, and therefore a result.h5, ascending
  std::vector<SampleRange> with_history;  ///< the last samples of other ended jobs that have some
  std::int64_t jobs = 0;
  std::int64_t sweeps = 0;
};

/// Checks a journal against the daemon's assumptions: SQLite's own checks of pages, indexes and references, then every
/// row of every table. Changes nothing and sees one moment, so that it may run beside a daemon. Throws ServiceError:
/// failed_precondition for a later version, data_loss if the file cannot be read at all.
JournalFindings check_journal(Database& database);

/// Problems of a backup or data folder, and its contents.
struct Verification {
  std::vector<std::string> problems;  ///< one or two sentences each, with the remedy
  std::vector<std::string> notes;     ///< unusual but harmless
  bool is_backup = false;
  std::string created;  ///< of a backup
  std::int64_t jobs = 0;
  std::int64_t sweeps = 0;
  std::int64_t results = 0;
};

/// Reads a whole backup or data folder, even while a daemon runs on it. Checks the journal (check_journal), and that
/// every job with a summary has a result with a matching seal; for a backup also every file against the manifest.
/// Changes nothing. Throws ServiceError: not_found if the folder has no journal, internal if it cannot be read.
Verification verify_folder(const std::filesystem::path& folder);

}  // namespace cellcrush::store
