#pragma once

#include "cellcrush/v1/job.pb.h"

namespace cellcrush::store {

/// Whether a job in state `from` may go to state `to`.
bool may_follow(v1::JobState from, v1::JobState to);

/// Whether no state follows.
bool is_terminal(v1::JobState state);

}  // namespace cellcrush::store
