#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "store/sqlite.h"

namespace cellcrush::store {

/// One life of a journal; a restore starts another. Sequence numbers, resume tokens and workers' reports of an earlier
/// epoch are invalid, since their numbers may have been reused.
struct Epoch {
  std::string id;        ///< random
  std::string restored;  ///< time of the restore that started it, "2026-11-23T09:15:02Z"; empty without a restore

  /// Whether something of epoch `other` is valid in this one. An empty epoch is of a version without epochs and belongs
  /// to a journal that was never restored.
  [[nodiscard]] bool admits(const std::string& other) const {
    return other == id || (other.empty() && restored.empty());
  }

  /// " of before a restore of the data (2026-11-23T09:15:02Z)", for what does not belong to this epoch.
  [[nodiscard]] std::string of_before() const {
    return restored.empty() ? " from an earlier journal, which was replaced"
                            : " from before the restore of " + restored;
  }
};

/// A value that the journal keeps beside the jobs; empty if there is none, or a damaged one. Throws ServiceError.
std::string read_fact(Database& database, const std::string& name);
void write_fact(Database& database, const std::string& name, const std::string& value);

/// The journal's epoch; empty if it has none yet, or a damaged one. Throws ServiceError.
Epoch read_epoch(Database& database);

/// The epoch as callers see it: a copy of the data folder has the journal's epoch, but another one for callers, since
/// both go on to other jobs.
Epoch epoch_for_callers(Epoch epoch, const std::filesystem::path& journal);

/// Starts a new epoch; `restored` as in Epoch. Throws ServiceError.
void begin_epoch(Database& database, const std::string& restored);

/// Creates the tables of a new journal, or upgrades one of the three versions before. Returns the seconds counted by
/// the service clock (ServiceClock). Throws ServiceError (failed_precondition) for a journal of another version.
std::int64_t prepare_journal(Database& database, const std::filesystem::path& data_folder);

/// Throws ServiceError (failed_precondition) for a journal of another version.
void require_known_version(Database& database);

}  // namespace cellcrush::store
