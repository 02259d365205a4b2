#include "store/job_filter.h"

#include <algorithm>
#include <utility>

namespace cellcrush::store {

std::string folded_title(const std::string& title) {
  std::string out = title;
  for (char& character : out) {
    if (character >= 'A' && character <= 'Z') character = static_cast<char>(character - 'A' + 'a');
  }
  return out;
}

bool matches(const JobFilter& filter, const v1::Job& job) {
  const auto has_state = [&](v1::Job::State state) { return job.state() == state; };
  const auto has_owner = [&](const std::string& owner) { return job.owner() == owner; };
  const auto has_label = [&](const auto& label) {
    const auto found = job.labels().find(label.first);
    return found != job.labels().end() && found->second == label.second;
  };
  const std::string title = folded_title(job.title());
  const auto has_title = [&](const std::string& part) { return title.find(folded_title(part)) != std::string::npos; };
  return std::all_of(filter.states.begin(), filter.states.end(), has_state) &&
         std::all_of(filter.owners.begin(), filter.owners.end(), has_owner) &&
         std::all_of(filter.labels.begin(), filter.labels.end(), has_label) &&
         std::all_of(filter.titles.begin(), filter.titles.end(), has_title);
}

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
