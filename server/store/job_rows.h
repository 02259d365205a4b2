#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "cellcrush/v1/job.pb.h"
#include "store/contents.h"
#include "store/sqlite.h"

namespace cellcrush::store {

/// The blob that the journal stores for a job: every field without a column of its own, except transient ones.
std::string job_bytes(v1::Job job);

/// Adds or replaces the state event of this number, and makes the job's row agree, with the service clock's seconds of
/// its end if given. REQUIRES: a transaction is open. Throws ServiceError.
void add_state(Database& database, std::int64_t number, const v1::Job& job, std::int64_t sequence,
               std::optional<std::int64_t> ended_at = {});

/// Stores the mesh of a job, or another one. REQUIRES: a transaction is open. Throws ServiceError.
void insert_mesh(Database& database, std::int64_t job, const v1::Mesh& mesh);

/// Whether the job exists. Throws ServiceError.
bool has_job(Database& database, std::int64_t job);

/// Deletes all rows of a job. REQUIRES: a transaction is open. Throws ServiceError.
void remove_rows(Database& database, std::int64_t job);

/// What the journal stores about a new job beside the job itself.
struct JobEntry {
  std::string request_id;  ///< empty: no id
  std::string request_hash;
  std::optional<std::int64_t> submission;  ///< first job submitted with it; nothing: this one
  std::int64_t element_steps = 0;          ///< of the reference crush, which take as long as the run
};

/// Adds PENDING jobs with their first event to the journal. Prepares its statements once. Lives within a transaction.
class JobInserter {
 public:
  explicit JobInserter(Database& database);

  /// Returns the new job's number. A job that names no executor is local.
  std::int64_t insert(v1::Job job, const JobEntry& entry);

 private:
  Database& database_;
  ContentWriter contents_;
  Statement job_;
  Statement event_;
  Statement label_;
};

}  // namespace cellcrush::store
