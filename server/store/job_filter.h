#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "cellcrush/v1/job.pb.h"
#include "store/sqlite.h"

namespace cellcrush::store {

/// Selects the jobs that meet all conditions.
struct JobFilter {
  std::vector<v1::Job::State> states;
  std::vector<std::pair<std::string, std::string>> labels;  ///< key and value
  std::vector<std::string> titles;                          ///< each a part of the case's title, ignoring case
  std::vector<std::string> owners;
};

/// A title as filters compare it: ASCII letters in lower case, all else unchanged.
std::string folded_title(const std::string& title);

/// Whether a job meets all conditions. Its own title counts, as a job in an event has no case.
bool matches(const JobFilter& filter, const v1::Job& job);

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
