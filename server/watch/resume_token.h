#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace cellcrush::watch {

/// A job of a sweep and how far a watcher has been given its events.
struct JobPlace {
  std::int64_t job = 0;
  std::int64_t sequence = 0;  ///< of the last event that was given; 0: none
  bool ended = false;         ///< its last event was given
};

/// Packs the places of all jobs of a sweep into a token. Jobs of one sweep have mostly consecutive numbers and many of
/// them are in the same place, so that the token stays short.
/// REQUIRES: the jobs are in ascending order.
std::string resume_token_of(std::int64_t sweep, const std::vector<JobPlace>& places);

/// The places in a token, by job. Throws ServiceError (invalid) for what is no token of that sweep.
std::map<std::int64_t, JobPlace> parse_resume_token(std::int64_t sweep, const std::string& token);

}  // namespace cellcrush::watch
