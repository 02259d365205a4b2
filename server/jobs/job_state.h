#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "cellcrush/v1/job.pb.h"

namespace cellcrush::jobs {

/// Whether a job in state `from` may go to state `to`.
bool may_follow(v1::JobState from, v1::JobState to);

/// Whether no state follows.
bool is_terminal(v1::JobState state);

/// "jobs/12" for 12.
std::string name_of(std::int64_t job);

/// 12 for "jobs/12"; nothing for what cannot be the name of a job.
std::optional<std::int64_t> number_of(std::string_view name);

}  // namespace cellcrush::jobs
