#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "store/job_filter.h"
#include "store/sqlite.h"

namespace cellcrush::store {

/// A filter as SQL conditions on the numbers of jobs. Each has an index, so that none reads the rows of other jobs.
class JobConditions {
 public:
  /// Numbers its parameters from `first_parameter`.
  JobConditions(const JobFilter& filter, int first_parameter);

  /// Where the numbers are that the conditions select from.
  struct Numbers {
    const char* table;
    const char* column;
  };
  [[nodiscard]] const Numbers& numbers() const { return numbers_; }

  /// " AND ..." for each condition; empty without conditions.
  [[nodiscard]] const std::string& sql() const { return sql_; }

  void bind_to(Statement& statement) const;

 private:
  std::string next_parameter(std::variant<std::int64_t, std::string> value);

  int first_parameter_;
  Numbers numbers_{"jobs", "number"};
  std::string sql_;
  std::vector<std::variant<std::int64_t, std::string>> values_;
};

}  // namespace cellcrush::store
