#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace cellcrush::watch {

/// A watcher's position in the events of one job of a sweep.
struct JobPlace {
  std::int64_t job = 0;
  std::int64_t sequence = 0;  ///< of the last event sent; 0: none
  bool ended = false;         ///< its last event was sent
};

/// Encodes the positions in all jobs of a sweep as a token. Most jobs of a sweep have consecutive numbers and equal
/// positions, so that the token stays short.
/// REQUIRES: the jobs are in ascending order.
std::string resume_token_of(std::int64_t sweep, const std::vector<JobPlace>& places);

/// The positions in a token, by job. Throws ServiceError (invalid) if it is not a token of this sweep.
std::map<std::int64_t, JobPlace> parse_resume_token(std::int64_t sweep, const std::string& token);

}  // namespace cellcrush::watch
