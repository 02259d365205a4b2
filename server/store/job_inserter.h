#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "cellcrush/v1/job.pb.h"
#include "store/search_columns.h"
#include "store/sqlite.h"

namespace cellcrush::store {

/// What the journal notes of a new job beside the job itself.
struct JobEntry {
  std::string request_id;  ///< empty: none
  std::string request_hash;
  std::optional<std::int64_t> submission;  ///< the first job that is submitted with it; nothing: it is the first
  std::int64_t element_steps = 0;          ///< elements times steps of its run
};

/// Adds jobs to the journal, PENDING and with their first event. Prepared once for many. Lives within a transaction.
class JobInserter {
 public:
  explicit JobInserter(Database& database);

  /// Returns the new job's number.
  std::int64_t insert(v1::Job job, const JobEntry& entry);

 private:
  Database& database_;
  Statement job_;
  Statement event_;
  LabelInserter labels_;
};

}  // namespace cellcrush::store
