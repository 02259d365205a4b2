#pragma once

#include <cstdint>
#include <string>

#include "cellcrush/v1/job.pb.h"
#include "store/sqlite.h"

namespace cellcrush::store {

/// A title as the journal compares it: ASCII letters in lower case, others as they are.
std::string folded_title(const std::string& title);

/// Writes the labels of a job where ListJobs looks for them. Prepared once for many. Lives within a transaction.
class LabelInserter {
 public:
  explicit LabelInserter(Database& database)
      : insert_(database, "INSERT INTO job_labels (key, value, job) VALUES (?1, ?2, ?3)") {}

  void insert(std::int64_t job, const google::protobuf::Map<std::string, std::string>& labels);

 private:
  Statement insert_;
};

/// Fills in what version 4 of the journal keeps in columns beside the messages: owner, title and labels of each job,
/// the bytes it takes, and for those that have ended the second 0 of the service clock; the owner of each sweep. A row
/// whose message cannot be read keeps the defaults. Lives within a transaction. Throws ServiceError.
void fill_in_search_columns(Database& database);

}  // namespace cellcrush::store
