#pragma once

#include <string>

#include "store/sqlite.h"

namespace cellcrush::store {

/// One life of a journal: a restore begins another. Sequence numbers, resume tokens and workers' reports of an earlier
/// one do not count, for a number may stand for something else since.
struct Epoch {
  std::string id;        ///< random
  std::string restored;  ///< when the restore was that began it, "2026-11-23T09:15:02Z"; empty: none did

  /// Whether something that names `other` belongs to this epoch. An empty one is of a version without epochs: it
  /// belongs to a journal that was never restored.
  [[nodiscard]] bool admits(const std::string& other) const {
    return other == id || (other.empty() && restored.empty());
  }

  /// " of before a restore of the data (2026-11-23T09:15:02Z)", for what does not belong to it.
  [[nodiscard]] std::string of_before() const {
    return restored.empty() ? " from an earlier journal, which was replaced"
                            : " from before the restore of " + restored;
  }
};

/// The journal's epoch; an empty one when it has none yet. Throws ServiceError.
Epoch read_epoch(Database& database);

/// Gives a new id to a journal without one. Throws ServiceError.
void ensure_epoch(Database& database);

/// Begins a new epoch: the journal was restored at that time. Throws ServiceError.
void begin_epoch(Database& database, const std::string& restored);

}  // namespace cellcrush::store
