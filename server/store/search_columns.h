#pragma once

#include <cstdint>
#include <string>

#include "cellcrush/v1/job.pb.h"
#include "store/sqlite.h"

namespace cellcrush::store {

/// A title as the journal compares it: ASCII letters in lower case, all else unchanged.
std::string folded_title(const std::string& title);

/// Writes the labels of a job to the index of ListJobs. Prepares its statements once. Lives within a transaction.
class LabelInserter {
 public:
  explicit LabelInserter(Database& database)
      : insert_(database, "INSERT INTO job_labels (key, value, job) VALUES (?1, ?2, ?3)") {}

  void insert(std::int64_t job, const google::protobuf::Map<std::string, std::string>& labels);

 private:
  Statement insert_;
};

}  // namespace cellcrush::store
