#pragma once

#include <cstddef>
#include <string>

#include "store/epoch.h"

namespace cellcrush::rpc {

// Maximum lengths of request fields other than a case, in bytes. They far exceed any use, but keep a caller from
// occupying the daemon with a text of 4 MiB, the size limit of a message. A token of WatchSweep has up to 20 bytes for
// each job.
inline constexpr std::size_t kLongestName = 128;
inline constexpr std::size_t kLongestFilter = 4096;
inline constexpr std::size_t kLongestOrder = 128;
inline constexpr std::size_t kLongestPageToken = 128;
inline constexpr std::size_t kLongestResumeToken = 3 * 1024 * 1024;
inline constexpr std::size_t kLongestJobsToken = 128;

/// Maximum size of a request, in bytes.
inline constexpr int kLargestMessage = 4 * 1024 * 1024;

/// Maximum number of jobs that one WatchJobs watches in full.
inline constexpr int kMostWatchedJobs = 64;

/// Maximum size of a case, or of a sweep with its case and points, in bytes. A returned Job or Sweep adds the daemon's
/// own fields and must fit in 4 MiB, the default limit of a client. plan_sweep limits a sweep of many points further.
inline constexpr std::size_t kLargestCase = 4'000'000;

/// Throws InvalidField if it is larger.
void check_size(const std::string& field, std::size_t bytes, std::size_t largest);

/// Throws InvalidField if the text is longer.
void check_length(const std::string& field, const std::string& text, std::size_t longest);

/// Throws ServiceError (failed_precondition) if the caller's epoch differs from the journal's. An empty epoch always
/// passes.
void check_epoch(const store::Epoch& epoch, const std::string& given);

}  // namespace cellcrush::rpc
