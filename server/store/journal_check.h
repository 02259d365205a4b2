#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "store/sqlite.h"

namespace cellcrush::store {

/// What a look at every row of a journal found.
struct JournalFindings {
  std::vector<std::string> problems;      ///< a sentence or two each, with the remedy
  std::vector<std::int64_t> with_result;  ///< jobs that have ended with a summary, and so with a result.h5, ascending
  std::int64_t jobs = 0;
  std::int64_t sweeps = 0;
};

/// Holds a journal to what the daemon relies on: SQLite's own checks of its pages, indexes and references, then every
/// row of every table. It changes nothing, and may run beside a daemon: it sees one moment. Throws ServiceError:
/// failed_precondition for a later version, data_loss when the file cannot be read at all.
JournalFindings check_journal(Database& database);

}  // namespace cellcrush::store
