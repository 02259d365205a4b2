#pragma once

#include <string>
#include <utility>
#include <vector>

#include "cellcrush/v1/job.pb.h"

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

}  // namespace cellcrush::store
