#include "store/job_filter.h"

#include <algorithm>
#include <cctype>

namespace cellcrush::store {
namespace {

bool contains(const std::string& text, const std::string& part) {
  const auto same = [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); };
  return std::search(text.begin(), text.end(), part.begin(), part.end(), same) != text.end();
}

}  // namespace

bool matches(const JobFilter& filter, const v1::Job& job) {
  const auto has_label = [&job](const auto& label) {
    const auto found = job.labels().find(label.first);
    return found != job.labels().end() && found->second == label.second;
  };
  return std::all_of(filter.states.begin(), filter.states.end(),
                     [&job](v1::JobState state) { return job.state() == state; }) &&
         std::all_of(filter.owners.begin(), filter.owners.end(),
                     [&job](const std::string& owner) { return job.owner() == owner; }) &&
         std::all_of(filter.labels.begin(), filter.labels.end(), has_label) &&
         std::all_of(filter.titles.begin(), filter.titles.end(),
                     [&job](const std::string& part) { return contains(job.case_().title(), part); });
}

}  // namespace cellcrush::store
