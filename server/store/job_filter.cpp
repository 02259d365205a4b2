#include "store/job_filter.h"

#include <algorithm>

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

}  // namespace cellcrush::store
