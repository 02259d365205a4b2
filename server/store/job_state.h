#pragma once

#include "cellcrush/v1/job.pb.h"

namespace cellcrush::store {

/// Whether a job may change from state `from` to state `to`.
bool may_follow(v1::JobState from, v1::JobState to);

/// Whether the state is final.
bool is_terminal(v1::JobState state);

}  // namespace cellcrush::store
