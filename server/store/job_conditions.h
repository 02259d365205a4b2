#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "store/job_filter.h"
#include "store/sqlite.h"

namespace cellcrush::store {

/// A filter as SQL that follows a condition on `jobs`. Each condition has an index, so that none reads the rows of jobs
/// that are not wanted.
class JobConditions {
 public:
  /// Its parameters are numbered from `first_parameter`.
  JobConditions(const JobFilter& filter, int first_parameter);

  /// " AND ..." for each condition; empty without any.
  [[nodiscard]] const std::string& sql() const { return sql_; }

  void bind_to(Statement& statement) const;

 private:
  std::string next_parameter(std::variant<std::int64_t, std::string> value);

  int first_parameter_;
  std::string sql_;
  std::vector<std::variant<std::int64_t, std::string>> values_;
};

}  // namespace cellcrush::store
