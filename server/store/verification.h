#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace cellcrush::store {

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

class Database;

/// The damaged rows of a journal, a sentence each with the remedy. Throws ServiceError: data_loss if pages, indexes or
/// references are damaged.
std::vector<std::string> problems_of_rows(Database& journal);

/// Reads a whole backup or data folder, even while a daemon runs on it. Checks the journal (SQLite's own checks and
/// every row), and that every job with a summary has a result with a matching seal; for a backup also every file
/// against the manifest. Changes nothing. Throws ServiceError: not_found if the folder has no journal,
/// failed_precondition if it is of another version, internal if it cannot be read.
Verification verify_folder(const std::filesystem::path& folder);

}  // namespace cellcrush::store
