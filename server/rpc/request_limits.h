#pragma once

#include <cstddef>
#include <string>

#include "store/epoch.h"

namespace cellcrush::rpc {

// Lengths of what a request may carry beside a case, in bytes. They are far beyond what is of use, so that a caller
// does not keep the daemon busy with a text of 4 MiB, which a message may have.
inline constexpr std::size_t kLongestName = 128;
inline constexpr std::size_t kLongestFilter = 4096;
inline constexpr std::size_t kLongestOrder = 128;
inline constexpr std::size_t kLongestPageToken = 128;
inline constexpr std::size_t kLongestResumeToken = 1024 * 1024;

/// Of a case, or of a sweep with its case and points, in bytes: a Job or Sweep that is answered has besides what the
/// daemon knows of it, and is to stay under the 4 MiB that a client takes by default.
inline constexpr std::size_t kLargestCase = 4'000'000;

/// Throws InvalidField when it is larger.
void check_size(const std::string& field, std::size_t bytes, std::size_t largest);

/// Throws InvalidField when the text is longer.
void check_length(const std::string& field, const std::string& text, std::size_t longest);

/// Throws ServiceError (failed_precondition) when a caller continues what belongs to another epoch of the journal; an
/// empty one is not compared.
void check_epoch(const store::Epoch& epoch, const std::string& given);

}  // namespace cellcrush::rpc
