#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "open_file.h"
#include "store/sqlite.h"

namespace cellcrush::store {

/// How many changes a journal has had, in a file beside it. SQLite drops the transactions behind a damaged place of its
/// WAL without a word; this file then counts more changes than the journal.
class ChangeCount {
 public:
  /// `journal.changes` of the data folder; a missing or damaged one counts none.
  explicit ChangeCount(const std::filesystem::path& data_folder);

  /// Changes that the file counts and the journal lacks. 0 if the file is of another epoch
  /// and the journal has changes of its own. Throws ServiceError.
  [[nodiscard]] std::int64_t lost(Database& journal) const;

  /// Writes what the journal has now. Failures are left alone: the file then counts too few.
  void note(Database& journal);

 private:
  std::filesystem::path path_;
  std::string epoch_;
  std::int64_t count_ = 0;
  OpenFile file_;  ///< once something was noted
};

}  // namespace cellcrush::store
