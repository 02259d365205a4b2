#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace cellcrush::store {

/// What is wrong with a backup or a data folder, and what it holds.
struct Verification {
  std::vector<std::string> problems;  ///< a sentence or two each, with the remedy
  std::vector<std::string> notes;     ///< what is odd and harms nothing
  bool is_backup = false;
  std::string created;  ///< of a backup
  std::int64_t jobs = 0;
  std::int64_t sweeps = 0;
  std::int64_t results = 0;
};

/// Reads all of a backup, or of a data folder, also while a daemon runs on it: the journal (check_journal), and that
/// every job with a summary has a result whose seal is that of its bytes; of a backup that every file is the one of its
/// manifest. It changes nothing. Throws ServiceError: not_found when the folder holds no journal, internal when it
/// cannot be read.
Verification verify_folder(const std::filesystem::path& folder);

}  // namespace cellcrush::store
