#include "store/job_conditions.h"

#include <utility>

namespace cellcrush::store {

JobConditions::JobConditions(const JobFilter& filter, int first_parameter) : first_parameter_(first_parameter) {
  const bool by_label = filter.states.empty() && filter.owners.empty() && filter.titles.empty();
  if (by_label && filter.labels.size() == 1) {
    // The rows of a label are in the order of their jobs: a page reads as many as it lists.
    const auto& [key, value] = filter.labels.front();
    numbers_ = {"job_labels", "job"};
    sql_ = " AND key = " + next_parameter(key);
    sql_ += " AND value = " + next_parameter(value);
    return;
  }
  for (const v1::Job::State state : filter.states) sql_ += " AND state = " + next_parameter(std::int64_t{state});
  for (const auto& owner : filter.owners) sql_ += " AND owner = " + next_parameter(owner);
  for (const auto& [key, value] : filter.labels) {
    sql_ += " AND number IN (SELECT job FROM job_labels WHERE key = " + next_parameter(key);
    sql_ += " AND value = " + next_parameter(value) + " AND job > ?1 AND job < ?2)";
  }
  for (const auto& part : filter.titles) sql_ += " AND instr(title, " + next_parameter(folded_title(part)) + ") > 0";
}

void JobConditions::bind_to(Statement& statement) const {
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const int parameter = first_parameter_ + static_cast<int>(i);
    if (const auto* number = std::get_if<std::int64_t>(&values_[i])) {
      statement.bind(parameter, *number);
    } else {
      statement.bind_text(parameter, std::get<std::string>(values_[i]));
    }
  }
}

std::string JobConditions::next_parameter(std::variant<std::int64_t, std::string> value) {
  values_.push_back(std::move(value));
  return "?" + std::to_string(first_parameter_ + static_cast<int>(values_.size()) - 1);
}

}  // namespace cellcrush::store
